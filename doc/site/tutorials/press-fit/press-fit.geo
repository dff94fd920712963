// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Half sections of a shaft and of the hub on it, in mm: x is the radius, y the axis.
DefineConstant[ b = 10, c = 20, length = 20, n = 10 ]; // radius of the joint, of the hub; cells along the shaft's radius

Point(1) = {0, 0, 0};
Point(2) = {b, 0, 0};
Point(3) = {b, length, 0};
Point(4) = {0, length, 0};
Point(5) = {b, 0, 0};
Point(6) = {c, 0, 0};
Point(7) = {c, length, 0};
Point(8) = {b, length, 0};
For i In {0 : 3}
  Line(1 + i) = {1 + i, 1 + (i + 1) % 4};
  Line(5 + i) = {5 + i, 5 + (i + 1) % 4};
EndFor
Curve Loop(1) = {1 : 4};
Curve Loop(2) = {5 : 8};
Plane Surface(1) = {1};
Plane Surface(2) = {2};

Transfinite Curve{1 : 8} = n + 1; // rectangles of equal cells
Transfinite Surface{1, 2};
Recombine Surface{1, 2};

Physical Surface("shaft")       = {1};
Physical Surface("hub")         = {2};
Physical Curve("shaft surface") = {2};
Physical Curve("shaft top")     = {3};
Physical Curve("bore")          = {8};
Physical Curve("hub bottom")    = {5};
