// A strip along x, for waves that move along it. The cells are squares (or triangles of that size) unless height is set.
DefineConstant[
  length = {1, Name "length [m]"},
  n = {2000, Name "cells along x"},
  ny = {1, Name "cells across"},
  height = {0, Name "height [m], 0: ny length / n"},
  element = {4, Choices{3 = "triangles", 4 = "quadrilaterals"}, Name "element"}
];
If (element != 3 && element != 4)
  Error("tube.geo: element = %g, allowed: 3 (triangles), 4 (quadrilaterals)", element);
  Exit;
EndIf
h = height > 0 ? height : ny * length / n;

Point(1) = {0, 0, 0};
line[] = Extrude {length, 0, 0} { Point{1}; Layers{n}; };
If (element == 4)
  strip[] = Extrude {0, h, 0} { Line{line[1]}; Layers{ny}; Recombine; };
Else
  strip[] = Extrude {0, h, 0} { Line{line[1]}; Layers{ny}; };
EndIf

Physical Curve("bottom") = {line[1]};
Physical Curve("top") = {strip[0]};
Physical Curve("left") = {strip[3]};
Physical Curve("right") = {strip[2]};
Physical Surface("domain") = {strip[1]};
