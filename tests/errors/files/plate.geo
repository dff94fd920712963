// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A block, drawn. It is right as it is: rows of meshes.txt make it wrong.
SetFactory("OpenCASCADE");
DefineConstant[ height = 1 ];
Box(1) = {0, 0, 0, 2, 1, height};
Physical Volume("BLOCK") = {1};
Physical Surface("FLOOR") = {5};
Physical Surface("TOP") = {6};
Mesh.MeshSizeMax = 1;
