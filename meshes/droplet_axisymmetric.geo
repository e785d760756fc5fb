// A cylinder of jelly that stands on a wall, x the height above it, y the distance from the axis: the meridian plane of
// droplet.geo, with the same layers (half as high at the wall as further up) and the room it spreads into. The mesh is
// fitted to the cylinder: physical surfaces jelly and surroundings.
DefineConstant[
  radius = {6e-3, Name "radius of the cylinder, R0 [m]"},
  body = {8e-3, Name "height of the cylinder [m]"},
  height = {10e-3, Name "height of the domain [m]"},
  outer = {3, Name "outer radius of the domain, in R0"},
  h = {0.4e-3, Name "size of a cell [m]"},
  wall = {0.5, Name "size at the wall, in h"},
  element = {4, Choices{3 = "triangles", 4 = "quadrilaterals"}, Name "element"}
];
If (element != 3 && element != 4)
  Error("droplet_axisymmetric.geo: element = %g, allowed: 3 (triangles), 4 (quadrilaterals)", element);
  Exit;
EndIf
If (outer <= 1 || height <= body)
  Error("droplet_axisymmetric.geo: needed: 1 < outer and body < height");
  Exit;
EndIf

// Layers grow by 15 % from the wall up to h and are scaled together to end at the cylinder's height.
x = 0;
thickness = wall * h;
levels[] = {};
For i In {1:10000}
  If (x < body - 0.5 * thickness)
    x = x + thickness;
    levels[] += x;
    thickness = thickness * 1.15 < h ? thickness * 1.15 : h;
  EndIf
EndFor
ones[] = {};
For i In {0:#levels[] - 1}
  levels[i] = levels[i] / x;
  ones[] += 1;
EndFor
n_above = Round((height - body) / h) > 1 ? Round((height - body) / h) : 1;

Point(1) = {0, 0, 0};
Point(2) = {0, radius, 0};
Point(3) = {0, outer * radius, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Transfinite Curve {1} = Round(radius / h) + 1;
Transfinite Curve {2} = Round((outer - 1) * radius / h) + 1;
// The layers of triangles follow those of the quadrilaterals too: a body falls on a straight front.
For i In {1:2}
  If (element == 4)
    below[] = Extrude {body, 0, 0} { Curve{i}; Layers{ones[], levels[]}; Recombine; };
    above[] = Extrude {height - body, 0, 0} { Curve{below[0]}; Layers{n_above}; Recombine; };
  Else
    below[] = Extrude {body, 0, 0} { Curve{i}; Layers{ones[], levels[]}; };
    above[] = Extrude {height - body, 0, 0} { Curve{below[0]}; Layers{n_above}; };
  EndIf
  part[] += {below[1], above[1]};
EndFor

e = 1e-3 * h;
floor[] = Curve In BoundingBox{-e, -e, -e, e, outer * radius + e, e};
lid[] = Curve In BoundingBox{height - e, -e, -e, height + e, outer * radius + e, e};
axis[] = Curve In BoundingBox{-e, -e, -e, height + e, e, e};
rim[] = Curve In BoundingBox{-e, outer * radius - e, -e, height + e, outer * radius + e, e};
Physical Curve("wall") = {floor[]};
Physical Curve("top") = {lid[]};
Physical Curve("axis") = {axis[]};
Physical Curve("outer") = {rim[]};
Physical Surface("jelly") = {part[0]};
Physical Surface("surroundings") = {part[1], part[2], part[3]};
