// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The bracket of bracket.prm, in mm. `gmsh -3 bracket.geo` writes bracket.msh.
SetFactory("OpenCASCADE");

// Section in the plane y = 0: foot, upright and the fillet between them, drawn out to y = 40.
Point(1) = {0, 0, 0};
Point(2) = {60, 0, 0};
Point(3) = {60, 0, 8};
Point(4) = {18, 0, 8};
Point(5) = {18, 0, 18}; // centre of the fillet
Point(6) = {8, 0, 18};
Point(7) = {8, 0, 60};
Point(8) = {0, 0, 60};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Circle(4) = {4, 5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {8, 1};
Curve Loop(1) = {1 : 7};
Plane Surface(1) = {1};
part[] = Extrude {0, 40, 0} { Surface{1}; };

// Two holes for bolts and one for a pin.
Cylinder(11) = {45, 10, -1, 0, 0, 10, 3.3};
Cylinder(12) = {45, 30, -1, 0, 0, 10, 3.3};
Cylinder(13) = {-1, 20, 42, 10, 0, 0, 10};
BooleanDifference(20) = { Volume{part[1]}; Delete; }{ Volume{11 : 13}; Delete; };

// Rings on the foot, where the washers press.
Disk(101) = {45, 10, 8, 7};
Disk(102) = {45, 30, 8, 7};
BooleanFragments{ Volume{20}; Delete; }{ Surface{101, 102}; Delete; }

e = 0.01;
Physical Volume("steel") = Volume In BoundingBox {-e, -e, -e, 60 + e, 40 + e, 60 + e};
Physical Surface("sole") = Surface In BoundingBox {-e, -e, -e, 60 + e, 40 + e, e};
Physical Surface("washers") = {Surface In BoundingBox {38 - e, 3 - e, 8 - e, 52 + e, 17 + e, 8 + e},
                               Surface In BoundingBox {38 - e, 23 - e, 8 - e, 52 + e, 37 + e, 8 + e}};
Physical Surface("bore") = Surface In BoundingBox {-e, 10 - e, 32 - e, 8 + e, 30 + e, 52 + e};

Mesh.MeshSizeMax = 5;
Mesh.MeshSizeFromCurvature = 12; // cells around a circle
