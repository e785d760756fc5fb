// The meridian plane of the room around the top of a spherical wall, x the axis, y the distance from it: a sector of
// rings between the wall, whose top is the origin, and a sphere around it. Layers are half as high at the wall as
// further out. The corners of the cells lie on the spheres: the wall is a polygon.
DefineConstant[
  wall_radius = {6e-3, Name "radius of the wall [m]"},
  height = {8e-3, Name "height of the room [m]"},
  angle = {80, Name "half the opening of the sector, from the axis [degrees]"},
  h = {0.2e-3, Name "size of a cell at the wall [m]"},
  element = {4, Choices{3 = "triangles", 4 = "quadrilaterals"}, Name "element"}
];
If (element != 3 && element != 4)
  Error("round_wall.geo: element = %g, allowed: 3 (triangles), 4 (quadrilaterals)", element);
  Exit;
EndIf
If (wall_radius <= 0 || height <= 0 || angle <= 0 || angle > 90)
  Error("round_wall.geo: needed: 0 < wall_radius, 0 < height and 0 < angle <= 90");
  Exit;
EndIf
outer = wall_radius + height;
phi = angle * Pi / 180;

Point(1) = {-wall_radius, 0, 0};
Point(2) = {0, 0, 0};
Point(3) = {-wall_radius + wall_radius * Cos(phi), wall_radius * Sin(phi), 0};
Point(4) = {-wall_radius + outer * Cos(phi), outer * Sin(phi), 0};
Point(5) = {height, 0, 0};
Circle(1) = {2, 1, 3};
Line(2) = {3, 4};
Circle(3) = {4, 1, 5};
Line(4) = {5, 2};
Curve Loop(1) = {4, 1, 2, 3};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = Round(phi * wall_radius / h) + 1;
n = Round(height / (1.5 * h));
Transfinite Curve {2} = n + 1 Using Progression 3^(1 / n);
Transfinite Curve {-4} = n + 1 Using Progression 3^(1 / n);
Transfinite Surface {1} = {2, 3, 4, 5};
If (element == 4)
  Recombine Surface {1};
EndIf

Physical Curve("wall") = {1};
Physical Curve("side") = {2};
Physical Curve("outer") = {3};
Physical Curve("axis") = {4};
Physical Surface("room") = {1};
