// A quarter of a ring around the origin, between x = 0 and y = 0, and the room within and around it. Corners of cells
// lie on the circles.
DefineConstant[
  inner = {1, Name "inner radius of the ring [m]"},
  outer = {2, Name "outer radius of the ring [m]"},
  within = {0.2, Name "inner radius of the room [m]"},
  around = {2.5, Name "outer radius of the room [m]"},
  h = {0.1, Name "size of a cell [m]"},
  element = {4, Choices{3 = "triangles, unstructured", 4 = "quadrilaterals"}, Name "element"}
];
If (element != 3 && element != 4)
  Error("quarter_ring.geo: element = %g, allowed: 3 (triangles), 4 (quadrilaterals)", element);
  Exit;
EndIf
If (within <= 0 || inner <= within || outer <= inner || around <= outer || h <= 0)
  Error("quarter_ring.geo: needed: 0 < within < inner < outer < around and 0 < h");
  Exit;
EndIf
r[] = {within, inner, outer, around};

Point(1) = {0, 0, 0};
For i In {0:3}
  Point(10 + i) = {r[i], 0, 0, h};
  Point(20 + i) = {0, r[i], 0, h};
  Circle(30 + i) = {10 + i, 1, 20 + i};
  n_round = Round(Pi / 2 * r[i] / h);
  If (element == 4)
    n_round = Round(Pi / 4 * (inner + outer) / h);
  EndIf
  Transfinite Curve {30 + i} = n_round + 1;
EndFor
For i In {0:2}
  Line(40 + i) = {10 + i, 11 + i};
  Line(50 + i) = {20 + i, 21 + i};
  Curve Loop(60 + i) = {40 + i, 31 + i, -(50 + i), -(30 + i)};
  Plane Surface(70 + i) = {60 + i};
  Transfinite Curve {40 + i, 50 + i} = Ceil((r[i + 1] - r[i]) / h - 1e-6) + 1;
EndFor
If (element == 4)
  Transfinite Surface {70:72};
  Recombine Surface {70:72};
EndIf
Mesh.Algorithm = 6;  // Frontal-Delaunay

Physical Curve("within") = {30};
Physical Curve("around") = {33};
Physical Curve("bottom") = {40:42};
Physical Curve("left") = {50:52};
Physical Surface("ring") = {71};
Physical Surface("room") = {70, 72};
