// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A snap-fit arm with its hook, and the round catch that it passes, in mm. The arm is clamped at x = 0.
DefineConstant[ L = 20, h = 1.6, height = 1.1, alpha = 30, beta = 45, r = 1 ];
// length and thickness of the arm; height of the hook, angles of its front and of its back; radius of the catch
back = L + height / Tan(beta * Pi/180);
land = back + 0.8;
nose = land + height / Tan(alpha * Pi/180);

Point(1) = {0, -h, 0, h/3};
Point(2) = {nose, -h, 0, h/3};
Point(3) = {nose, 0, 0, 0.2};
Point(4) = {land, height, 0, 0.2};
Point(5) = {back, height, 0, 0.2};
Point(6) = {L, 0, 0, 0.2};
Point(7) = {0, 0, 0, h/3};
For i In {1 : 6}
  Line(i) = {i, i + 1};
EndFor
Line(7) = {7, 1};
Curve Loop(1) = {1 : 7};
Plane Surface(1) = {1};

x = nose + 0.3; // a half disc, its lowest point is 0.1 above the arm
y = 0.1 + r;
Point(11) = {x, y, 0, 0.2};
For i In {0 : 4}
  Point(12 + i) = {x - r * Cos(i * Pi/4), y - r * Sin(i * Pi/4), 0, (i % 4 == 0) ? 0.3 : 0.03};
EndFor
For i In {11 : 14}
  Circle(i) = {i + 1, 11, i + 2};
EndFor
Line(15) = {16, 12};
Curve Loop(2) = {11 : 15};
Plane Surface(2) = {2};

Physical Surface("arm")   = {1};
Physical Surface("catch") = {2};
Physical Curve("hook")    = {3, 4, 5};
Physical Curve("root")    = {7};
Physical Curve("round")   = {12, 13};
Physical Curve("held")    = {15};
