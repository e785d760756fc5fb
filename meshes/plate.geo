// Half of a projectile in contact with a plate, and room around them: x along the flight, y = 0 the plane of symmetry.
// Lines of the mesh follow the bodies: physical surfaces copper and surroundings. Cells have the size h where the bodies
// are and will be, and grow beyond.
DefineConstant[
  h = {2.5e-3, Name "size of a cell where the bodies are [m]"},
  growth = {1.1, Name "ratio of neighbouring cells beyond"},
  tail = {0.1, Name "x of the projectile's rear [m]"},
  side = {0.1, Name "length and height of the projectile, thickness of the plate [m]"},
  plate = {0.5, Name "height of the plate [m]"},
  swing = {0.1, Name "room behind the plate with cells of size h [m]"},
  length = {0.5, Name "length of the domain [m]"},
  height = {0.6, Name "height of the whole domain [m]"},
  element = {4, Choices{3 = "triangles, unstructured", 4 = "quadrilaterals"}, Name "element"}
];
If (element != 3 && element != 4)
  Error("plate.geo: element = %g, allowed: 3 (triangles), 4 (quadrilaterals)", element);
  Exit;
EndIf
If (tail <= 0 || tail + 2 * side + swing >= length || plate <= side || plate >= height)
  Error("plate.geo: needed: 0 < tail, tail + 2 side + swing < length, side < plate < height");
  Exit;
EndIf

// Blocks between these lines; cells in each, and where they grow: -1 towards smaller coordinates, 1 towards larger ones.
xs[] = {0, tail, tail + side, tail + 2 * side, tail + 2 * side + swing, length};
ys[] = {0, side / 2, plate / 2, height / 2};
x_grows[] = {-1, 0, 0, 0, 1};
y_grows[] = {0, 0, 1};
n_x = #xs[] - 1;
n_y = #ys[] - 1;
For i In {0:n_x - 1}
  If (x_grows[i] == 0)
    x_cells[i] = Ceil((xs[i + 1] - xs[i]) / h - 1e-6);
  Else
    x_cells[i] = Ceil(Log(1 + (xs[i + 1] - xs[i]) * (growth - 1) / h) / Log(growth));
  EndIf
EndFor
For j In {0:n_y - 1}
  If (y_grows[j] == 0)
    y_cells[j] = Ceil((ys[j + 1] - ys[j]) / h - 1e-6);
  Else
    y_cells[j] = Ceil(Log(1 + (ys[j + 1] - ys[j]) * (growth - 1) / h) / Log(growth));
  EndIf
EndFor

For j In {0:n_y}
  For i In {0:n_x}
    Point(1 + i + j * (n_x + 1)) = {xs[i], ys[j], 0};
  EndFor
EndFor
upright = (n_y + 1) * n_x; // lines along y come after those along x
For j In {0:n_y}
  For i In {0:n_x - 1}
    from = 1 + i + j * (n_x + 1);
    line = 1 + i + j * n_x;
    Line(line) = {from, from + 1};
    Transfinite Curve {line} = x_cells[i] + 1 Using Progression growth^x_grows[i];
    If (j == 0)
      bottom[] += {line};
    EndIf
    If (j == n_y)
      top[] += {line};
    EndIf
  EndFor
EndFor
For j In {0:n_y - 1}
  For i In {0:n_x}
    from = 1 + i + j * (n_x + 1);
    line = 1 + upright + i + j * (n_x + 1);
    Line(line) = {from, from + n_x + 1};
    Transfinite Curve {line} = y_cells[j] + 1 Using Progression growth^y_grows[j];
    If (i == 0)
      left[] += {line};
    EndIf
    If (i == n_x)
      right[] += {line};
    EndIf
  EndFor
EndFor
For j In {0:n_y - 1}
  For i In {0:n_x - 1}
    block = 1 + i + j * n_x;
    beside = 1 + upright + i + j * (n_x + 1);
    Curve Loop(block) = {block, beside + 1, -(block + n_x), -beside};
    Plane Surface(block) = {block};
    If (element == 4)
      Transfinite Surface {block};
      Recombine Surface {block};
    EndIf
    If ((i == 1 && j == 0) || (i == 2 && j <= 1))
      bodies[] += {block};
    Else
      around[] += {block};
    EndIf
  EndFor
EndFor
Mesh.Algorithm = 6;  // Frontal-Delaunay

Physical Curve("bottom") = {bottom[]};
Physical Curve("right") = {right[]};
Physical Curve("top") = {top[]};
Physical Curve("left") = {left[]};
Physical Surface("copper") = {bodies[]};
Physical Surface("surroundings") = {around[]};
