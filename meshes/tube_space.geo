// A bar along x with a square section, for waves that move along it. The cells are cubes (or tetrahedra of that size)
// unless width is set.
DefineConstant[
  length = {1, Name "length [m]"},
  n = {500, Name "cells along x"},
  ny = {2, Name "cells across, in y and in z"},
  width = {0, Name "width in y and z [m], 0: ny length / n"},
  element = {8, Choices{4 = "tetrahedra", 8 = "hexahedra"}, Name "element"}
];
If (element != 4 && element != 8)
  Error("tube_space.geo: element = %g, allowed: 4 (tetrahedra), 8 (hexahedra)", element);
  Exit;
EndIf
h = width > 0 ? width : ny * length / n;

Point(1) = {0, 0, 0};
line[] = Extrude {length, 0, 0} { Point{1}; Layers{n}; };
If (element == 8)
  floor[] = Extrude {0, h, 0} { Line{line[1]}; Layers{ny}; Recombine; };
  bar[] = Extrude {0, 0, h} { Surface{floor[1]}; Layers{ny}; Recombine; };
Else
  floor[] = Extrude {0, h, 0} { Line{line[1]}; Layers{ny}; };
  bar[] = Extrude {0, 0, h} { Surface{floor[1]}; Layers{ny}; };
EndIf

Physical Surface("back") = {floor[1]};   // z = 0
Physical Surface("front") = {bar[0]};
Physical Surface("bottom") = {bar[2]};
Physical Surface("right") = {bar[3]};
Physical Surface("top") = {bar[4]};
Physical Surface("left") = {bar[5]};
Physical Volume("domain") = {bar[1]};
