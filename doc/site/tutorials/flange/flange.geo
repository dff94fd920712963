// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// An eighth of a pipe's flange with one of its eight bolts, in mm. The axis of the pipe is z, the other flange is the
// mirror of this one in z = 0, where the bolt is cut.
SetFactory("OpenCASCADE");
DefineConstant[ size = 5, face = 94 ]; // of cells at most; radius of the face that seals
sector = Pi/4;

// Section of flange and pipe in the plane y = 0: a raised face up to the radius face, a fillet of 4.
Point(1) = {50, 0, 0};
Point(2) = {face, 0, 0};
Point(3) = {face, 0, 1};
Point(4) = {95, 0, 1};
Point(5) = {95, 0, 16};
Point(6) = {60, 0, 16};
Point(7) = {60, 0, 20}; // centre of the fillet
Point(8) = {56, 0, 20};
Point(9) = {56, 0, 60};
Point(10) = {50, 0, 60};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Circle(6) = {6, 7, 8};
Line(7) = {8, 9};
Line(8) = {9, 10};
Line(9) = {10, 1};
Curve Loop(1) = {1 : 9};
Plane Surface(1) = {1};
Rotate {{0, 0, 1}, {0, 0, 0}, -sector/2} { Surface{1}; }
part[] = Extrude {{0, 0, 1}, {0, 0, 0}, sector} { Surface{1}; };

// The hole, and the upper half of the bolt: shank and head.
Cylinder(11) = {82, 0, -1, 0, 0, 30, 5.5};
BooleanDifference(20) = { Volume{part[1]}; Delete; }{ Volume{11}; Delete; };
Cylinder(12) = {82, 0, 0, 0, 0, 16, 5};
Cylinder(13) = {82, 0, 16, 0, 0, 7, 8.5};
BooleanUnion(21) = { Volume{12}; Delete; }{ Volume{13}; Delete; };

e = 0.01;
Physical Volume("flange") = {20};
Physical Volume("bolt") = {21};
seal() = Surface In BoundingBox {40, -40, -e, face + e, 40, e};
Physical Surface("raised face") = {seal()};
Physical Surface("cut") = Surface In BoundingBox {76, -6, -e, 88, 6, e};
Physical Surface("seat") = Surface In BoundingBox {50, -40, 16 - e, 96, 40, 16 + e};
Physical Surface("pipe end") = Surface In BoundingBox {40, -40, 60 - e, 60, 40, 60 + e};
bore() = Surface In BoundingBox {40, -20, -e, 50 + e, 20, 60 + e};
Physical Surface("bore") = {bore()};
Physical Surface("sides") = {Surface In BoundingBox {46, 19, -e, 88, 37, 61}, Surface In BoundingBox {46, -37, -e, 88, -19, 61}};
Mesh.MeshSizeMax = size;
