// The unit cube in tetrahedra that Gmsh places freely, the surfaces of opposite sides alike.
DefineConstant[
  n = {8, Name "cells along an edge"}
];
h = 1 / n;
Mesh.CharacteristicLengthMin = h;
Mesh.CharacteristicLengthMax = h;

Point(1) = {0, 0, 0};
edge[] = Extrude {0, 1, 0} { Point{1}; };
floor[] = Extrude {1, 0, 0} { Line{edge[1]}; };
box[] = Extrude {0, 0, 1} { Surface{floor[1]}; };
e = 1e-3 * h;
left() = Surface In BoundingBox{-e, -e, -e, e, 1 + e, 1 + e};
right() = Surface In BoundingBox{1 - e, -e, -e, 1 + e, 1 + e, 1 + e};
bottom() = Surface In BoundingBox{-e, -e, -e, 1 + e, e, 1 + e};
top() = Surface In BoundingBox{-e, 1 - e, -e, 1 + e, 1 + e, 1 + e};
back() = Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, e};
front() = Surface In BoundingBox{-e, -e, 1 - e, 1 + e, 1 + e, 1 + e};
Periodic Surface {right()} = {left()} Translate {1, 0, 0};
Periodic Surface {top()} = {bottom()} Translate {0, 1, 0};
Periodic Surface {front()} = {back()} Translate {0, 0, 1};

Physical Surface("left") = left();
Physical Surface("right") = right();
Physical Surface("bottom") = bottom();
Physical Surface("top") = top();
Physical Surface("back") = back();
Physical Surface("front") = front();
Physical Volume("domain") = Volume{:};
