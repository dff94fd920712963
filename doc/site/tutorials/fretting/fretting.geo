// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A pad with a round face on a flat specimen, in mm; both touch at the origin.
DefineConstant[ R = 100, a = 1, n = 20 ]; // radius of the face, half width of contact that is expected, cells in it
fine = a / n;
far = 2 * a;
w = 10 * a; // half width of both

x = 1.4 * a;
Point(1) = {0, R, 0};
Point(2) = {-w, R - Sqrt(R^2 - w^2), 0, far};
Point(3) = {-x, R - Sqrt(R^2 - x^2), 0, fine};
Point(4) = {x, R - Sqrt(R^2 - x^2), 0, fine};
Point(5) = {w, R - Sqrt(R^2 - w^2), 0, far};
Point(6) = {w, w, 0, far};
Point(7) = {-w, w, 0, far};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 2};

Point(12) = {-w, 0, 0, far};
Point(13) = {-x, 0, 0, fine};
Point(14) = {x, 0, 0, fine};
Point(15) = {w, 0, 0, far};
Point(16) = {w, -w, 0, far};
Point(17) = {-w, -w, 0, far};
Line(11) = {12, 13};
Line(12) = {13, 14};
Line(13) = {14, 15};
Line(14) = {15, 16};
Line(15) = {16, 17};
Line(16) = {17, 12};

Curve Loop(1) = {1 : 6};
Curve Loop(2) = {11 : 16};
Plane Surface(1) = {1};
Plane Surface(2) = {-2};

Physical Surface("pad")      = {1};
Physical Surface("specimen") = {2};
Physical Curve("round")      = {2};
Physical Curve("pad back")   = {5};
Physical Curve("flat")       = {12};
Physical Curve("ground")     = {15};
