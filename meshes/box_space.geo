// A box: 0 <= x <= length, 0 <= y <= height, 0 <= z <= width. Mixed: hexahedra in the first third along x, prisms in the
// second, then a layer of pyramids and tetrahedra, then tetrahedra. (Gmsh's free meshing next to quadrilaterals is no way
// to get pyramids: it leaves inverted and flat elements.)
DefineConstant[
  length = {1, Name "length in x [m]"},
  height = {1, Name "height in y [m]"},
  width = {1, Name "width in z [m]"},
  n = {20, Name "cells along x"},
  element = {8, Choices{0 = "mixed", 4 = "tetrahedra, unstructured", 8 = "hexahedra"}, Name "element"}
];
If (element != 0 && element != 4 && element != 8)
  Error("box_space.geo: element = %g, allowed: 0 (mixed), 4 (tetrahedra), 8 (hexahedra)", element);
  Exit;
EndIf
If (element == 0 && n < 4)
  Error("box_space.geo: n = %g, allowed for a mixed mesh: from 4", n);
  Exit;
EndIf
h = length / n;
ny = Round(height / h);
nz = Round(width / h);
third = n == 5 ? 1 : Round(n / 3);  // a layer remains for the tetrahedra
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;

Point(1) = {0, 0, 0};
If (element == 4)
  edge[] = Extrude {0, height, 0} { Point{1}; };
  floor[] = Extrude {length, 0, 0} { Line{edge[1]}; };
  Extrude {0, 0, width} { Surface{floor[1]}; }
Else
  edge[] = Extrude {0, height, 0} { Point{1}; Layers{ny}; };
  n_hexahedra = element == 8 ? n : third;
  floor[] = Extrude {n_hexahedra * h, 0, 0} { Line{edge[1]}; Layers{n_hexahedra}; Recombine; };
  Extrude {0, 0, width} { Surface{floor[1]}; Layers{nz}; Recombine; }
EndIf
If (element == 0)
  prisms_floor[] = Extrude {third * h, 0, 0} { Line{floor[0]}; Layers{third}; };
  Extrude {0, 0, width} { Surface{prisms_floor[1]}; Layers{nz}; Recombine; }
  joint_floor[] = Extrude {h, 0, 0} { Line{prisms_floor[0]}; Layers{1}; };
  Extrude {0, 0, width} { Surface{joint_floor[1]}; Layers{nz}; Recombine; QuadTriNoNewVerts; }
  rest = n - 2 * third - 1;
  rest_floor[] = Extrude {rest * h, 0, 0} { Line{joint_floor[0]}; Layers{rest}; };
  Extrude {0, 0, width} { Surface{rest_floor[1]}; Layers{nz}; }
EndIf

e = 1e-3 * h;
Physical Surface("left") = Surface In BoundingBox{-e, -e, -e, e, height + e, width + e};
Physical Surface("right") = Surface In BoundingBox{length - e, -e, -e, length + e, height + e, width + e};
Physical Surface("bottom") = Surface In BoundingBox{-e, -e, -e, length + e, e, width + e};
Physical Surface("top") = Surface In BoundingBox{-e, height - e, -e, length + e, height + e, width + e};
Physical Surface("back") = Surface In BoundingBox{-e, -e, -e, length + e, height + e, e};
Physical Surface("front") = Surface In BoundingBox{-e, -e, width - e, length + e, height + e, width + e};
Physical Volume("domain") = Volume{:};
