// A unit square of triangles or quadrilaterals, or the same square extruded to one layer of prisms or hexahedra.
DefineConstant[
  n = {10, Name "cells along an edge"},
  thickness = {0, Name "of the layer [m], 0: a plane mesh"},
  element = {3, Choices{3 = "triangles, prisms", 4 = "quadrilaterals, hexahedra"}, Name "element"}
];
Point(1) = {0, 0, 0, 1 / n};
Point(2) = {1, 0, 0, 1 / n};
Point(3) = {1, 1, 0, 1 / n};
Point(4) = {0, 1, 0, 1 / n};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
If (element == 4)
  Transfinite Curve {1:4} = n + 1;
  Transfinite Surface {1};
  Recombine Surface {1};
EndIf
If (thickness > 0)
  layer[] = Extrude {0, 0, thickness} { Surface{1}; Layers{1}; Recombine; };
  Physical Surface("sides") = {layer[2], layer[3], layer[4], layer[5]};
  Physical Surface("back") = {1};
  Physical Surface("front") = {layer[0]};
  Physical Volume("domain") = {layer[1]};
Else
  Physical Curve("sides") = {1:4};
  Physical Surface("domain") = {1};
EndIf
