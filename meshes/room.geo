// A rectangle around the origin: |x| <= length / 2, |y| <= height / 2.
DefineConstant[
  length = {1, Name "length [m]"},
  height = {1, Name "height [m]"},
  n = {100, Name "cells along x"},
  element = {4, Choices{3 = "triangles, unstructured", 4 = "quadrilaterals"}, Name "element"}
];
If (element != 3 && element != 4)
  Error("room.geo: element = %g, allowed: 3 (triangles), 4 (quadrilaterals)", element);
  Exit;
EndIf
h = length / n;
x = length / 2;
y = height / 2;

Point(1) = {-x, -y, 0, h};
Point(2) = {x, -y, 0, h};
Point(3) = {x, y, 0, h};
Point(4) = {-x, y, 0, h};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = n + 1;
Transfinite Curve {2, 4} = Round(height / h) + 1;
If (element == 4)
  Transfinite Surface {1};
  Recombine Surface {1};
EndIf
Mesh.Algorithm = 6;  // Frontal-Delaunay

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("room") = {1};
