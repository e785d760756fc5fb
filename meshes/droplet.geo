// A quarter of a cylinder of jelly that stands on a wall (z = 0, axis z) and of the room it spreads into. The mesh is
// fitted to the cylinder: physical volumes jelly and surroundings. Seen from above:
//
//   hexahedra: a square core, a ring out to the cylinder, a ring out to where the jelly spreads; prisms beyond.
//   tetrahedra: throughout, of about the same size.
//
// Layers are half as high at the wall as further up. Radii of the hexahedral mesh hold for the corners on the circles:
// the polygon they span has (pi/2 / cells)^2 / 6 less area, 0.1 % at 20 cells on the quarter circle.
DefineConstant[
  radius = {6e-3, Name "radius of the cylinder, R0 [m]"},
  body = {8e-3, Name "height of the cylinder [m]"},
  height = {10e-3, Name "height of the domain [m]"},
  outer = {3, Name "outer radius of the domain, in R0"},
  inner = {2.4, Name "radius where prisms begin, in R0"},
  h = {0.4e-3, Name "size of a cell [m]"},
  wall = {0.5, Name "size at the wall, in h"},
  element = {8, Choices{4 = "tetrahedra", 8 = "hexahedra, with prisms outside"}, Name "element"}
];
If (element != 4 && element != 8)
  Error("droplet.geo: element = %g, allowed: 4 (tetrahedra), 8 (hexahedra, with prisms outside)", element);
  Exit;
EndIf
If (inner <= 1 || outer <= inner || height <= body)
  Error("droplet.geo: needed: 1 < inner < outer and body < height");
  Exit;
EndIf
r1 = inner * radius;
r2 = outer * radius;
m = Round(2 * radius / (3 * h));       // cells along an edge of the core, and along an eighth of a circle
spacing = r1 * Pi / 4 / m;             // of the prisms' triangles

// In the plane of the wall: 1 centre; 2-4 the core; 5-7 on the cylinder; 8-10 on r1; 11-12 on r2.
// The core is nearly round: a squarer one has larger smallest cells, and so larger time steps, but the jelly then spreads
// visibly faster along its diagonal.
Point(1) = {0, 0, 0};
Point(2) = {0.7 * radius, 0, 0};
Point(3) = {0.5 * radius, 0.5 * radius, 0};
Point(4) = {0, 0.7 * radius, 0};
For i In {0:2}
  Point(5 + i) = {radius * Cos(i * Pi / 4), radius * Sin(i * Pi / 4), 0};
  Point(8 + i) = {r1 * Cos(i * Pi / 4), r1 * Sin(i * Pi / 4), 0, spacing};
EndFor
Point(11) = {r2, 0, 0, spacing};
Point(12) = {0, r2, 0, spacing};

Line(1) = {1, 2};   Line(2) = {2, 3};   Line(3) = {3, 4};   Line(4) = {4, 1};
Line(5) = {2, 5};   Line(6) = {3, 6};   Line(7) = {4, 7};
Circle(8) = {5, 1, 6};    Circle(9) = {6, 1, 7};
Line(10) = {5, 8};  Line(11) = {6, 9};  Line(12) = {7, 10};
Circle(13) = {8, 1, 9};   Circle(14) = {9, 1, 10};
Line(15) = {8, 11};       Circle(16) = {11, 1, 12};     Line(17) = {12, 10};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 8, -6, -2};
Curve Loop(3) = {6, 9, -7, -3};
Curve Loop(4) = {10, 13, -11, -8};
Curve Loop(5) = {11, 14, -12, -9};
Curve Loop(6) = {15, 16, 17, -14, -13};
For i In {1:6}
  Plane Surface(i) = {i};
EndFor

If (element == 8)
  Transfinite Curve {1:4, 8, 9, 13, 14} = m + 1;
  Transfinite Curve {5:7} = Round(radius / (4 * h)) + 1;
  Transfinite Curve {10:12} = Round((r1 - radius) / h) + 1;
  Transfinite Surface {1:5};
  Recombine Surface {1:5};

  // Layers grow by 15 % from the wall up to h and are scaled together to end at the cylinder's height.
  z = 0;
  thickness = wall * h;
  levels[] = {};
  For i In {1:10000}
    If (z < body - 0.5 * thickness)
      z = z + thickness;
      levels[] += z;
      thickness = thickness * 1.15 < h ? thickness * 1.15 : h;
    EndIf
  EndFor
  n_levels = #levels[];
  ones[] = {};
  For i In {0:n_levels - 1}
    levels[i] = levels[i] / z;
    ones[] += 1;
  EndFor
  n_above = Round((height - body) / h) > 1 ? Round((height - body) / h) : 1;
EndIf

jelly[] = {};
surroundings[] = {};
For i In {1:6}
  If (element == 8)
    below[] = Extrude {0, 0, body} { Surface{i}; Layers{ones[], levels[]}; Recombine; };
    above[] = Extrude {0, 0, height - body} { Surface{below[0]}; Layers{n_above}; Recombine; };
  Else
    below[] = Extrude {0, 0, body} { Surface{i}; };
    above[] = Extrude {0, 0, height - body} { Surface{below[0]}; };
  EndIf
  If (i <= 3)
    jelly[] += below[1];
  Else
    surroundings[] += below[1];
  EndIf
  surroundings[] += above[1];
EndFor

If (element == 4)
  // Edges of 1.9 h give tetrahedra about the volume of a cube of h; they grow with z from the wall and with r from r1.
  Field[1] = MathEval;
  Field[1].F = Sprintf("%g * 0.5 * (1 + %g + 0.1 * z / %g - Abs(%g + 0.1 * z / %g - 1)) + 0.15 * (Sqrt(x*x + y*y) - %g + Abs(Sqrt(x*x + y*y) - %g))",
    1.9 * h, wall, h, wall, h, r1, r1);
  Background Field = 1;
  Mesh.CharacteristicLengthExtendFromBoundary = 0;
  Mesh.CharacteristicLengthFromPoints = 0;
EndIf

e = 1e-3 * h;
floor[] = Surface In BoundingBox{-e, -e, -e, r2 + e, r2 + e, e};
lid[] = Surface In BoundingBox{-e, -e, height - e, r2 + e, r2 + e, height + e};
plane_x[] = Surface In BoundingBox{-e, -e, -e, e, r2 + e, height + e};
plane_y[] = Surface In BoundingBox{-e, -e, -e, r2 + e, e, height + e};
rim[] = Abs(CombinedBoundary{ Volume{:}; });
rim[] -= {floor[], lid[], plane_x[], plane_y[]};
Physical Surface("wall") = {floor[]};
Physical Surface("top") = {lid[]};
Physical Surface("symmetry_x") = {plane_x[]};
Physical Surface("symmetry_y") = {plane_y[]};
Physical Surface("outer") = {rim[]};
Physical Volume("jelly") = {jelly[]};
Physical Volume("surroundings") = {surroundings[]};
