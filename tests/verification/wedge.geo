// The meridian section of a thick tube of length 1 m, inner radius 0.3 m and outer radius 1 m, x along its axis; or the
// wedge that it sweeps when turned about the axis, one cell thick.
DefineConstant[
  n = {10, Name "cells along the tube"},
  angle = {0, Name "of the wedge [rad], 0: the section alone"}
];
inner = 0.3;
Point(1) = {0, inner, 0};
Point(2) = {1, inner, 0};
Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = n + 1;
Transfinite Curve {2, 4} = Round((1 - inner) * n) + 1;
Transfinite Surface {1};
Recombine Surface {1};
If (angle > 0)
  Rotate { {1, 0, 0}, {0, 0, 0}, -angle / 2 } { Surface{1}; }
  part[] = Extrude { {1, 0, 0}, {0, 0, 0}, angle } { Surface{1}; Layers{1}; Recombine; };
  Physical Surface("sides") = {1, part[0], part[2], part[3], part[4], part[5]};
  Physical Volume("domain") = {part[1]};
Else
  Physical Curve("sides") = {1:4};
  Physical Surface("domain") = {1};
EndIf
