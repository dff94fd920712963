// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Half of a roller and half of the block below it, in mm; the plane of symmetry is x = 0.
DefineConstant[ R = 50, a = 6.2, n = 12 ]; // radius, half width of contact that is expected, cells in it
fine = a / n;
far = R / 6;

Point(1) = {0, 0, 0, fine};
Point(2) = {R * Sin(Pi/12), R - R * Cos(Pi/12), 0, 3 * fine};
Point(3) = {R, R, 0, far};
Point(4) = {0, R, 0, far};
Circle(1) = {1, 4, 2};
Circle(2) = {2, 4, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};

Point(5) = {0, 0, 0, fine};
Point(6) = {R * Sin(Pi/12), 0, 0, 3 * fine};
Point(7) = {R, 0, 0, far};
Point(8) = {R, -4 * R, 0, 2 * far};
Point(9) = {0, -4 * R, 0, 2 * far};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 9};
Line(9) = {9, 5};

Curve Loop(1) = {1 : 4};
Curve Loop(2) = {5 : 9};
Plane Surface(1) = {1};
Plane Surface(2) = {-2};

Physical Surface("roller")      = {1};
Physical Surface("block")       = {2};
Physical Curve("tread")         = {1};
Physical Curve("top of roller") = {3};
Physical Curve("roller axis")   = {4};
Physical Curve("face")          = {5};
Physical Curve("block axis")    = {9};
Physical Curve("ground")        = {8};
