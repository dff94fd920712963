// SPDX-FileCopyrightText: Conetact authors
// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A brake disc about the z axis, 0 <= z <= 8, and a pad on either side, in mm: hexahedra, drawn out of lines.
DefineConstant[ bore = 50, rim = 100, r = 62, R = 92, angle = 36 ]; // radii of disc and pads; angle of the pads, degrees

Point(1) = {bore, 0, 0};
Point(2) = {rim, 0, 0};
Line(1) = {1, 2};
Transfinite Curve{1} = 6;
line = 1;
For i In {0 : 3} // four quarters of the ring
  q[] = Extrude {{0, 0, 1}, {0, 0, 0}, Pi/2} { Curve{line}; Layers{12}; Recombine; };
  line = q[0];
  v[] = Extrude {0, 0, 8} { Surface{q[1]}; Layers{2}; Recombine; };
  disc[i] = v[1];
EndFor
Coherence;

For side In {0 : 1} // from z = -10 to 0, and from 8 to 18
  z = -10 + 18 * side;
  p = newp;
  Point(p) = {r * Cos(-angle/2 * Pi/180), r * Sin(-angle/2 * Pi/180), z};
  Point(p + 1) = {R * Cos(-angle/2 * Pi/180), R * Sin(-angle/2 * Pi/180), z};
  l = newl;
  Line(l) = {p, p + 1};
  Transfinite Curve{l} = 7;
  s[] = Extrude {{0, 0, 1}, {0, 0, 0}, angle * Pi/180} { Curve{l}; Layers{8}; Recombine; };
  w[] = Extrude {0, 0, 10} { Surface{s[1]}; Layers{2}; Recombine; };
  pad[side] = w[1];
EndFor

e = 1e-3;
Physical Volume("disc") = {disc[]};
Physical Volume("lower pad") = {pad[0]};
Physical Volume("upper pad") = {pad[1]};
Physical Surface("lower face") = Surface In BoundingBox {-rim - e, -rim - e, -e, rim + e, rim + e, e};
Physical Surface("upper face") = Surface In BoundingBox {-rim - e, -rim - e, 8 - e, rim + e, rim + e, 8 + e};
Physical Surface("lower back") = Surface In BoundingBox {-rim - e, -rim - e, -10 - e, rim + e, rim + e, -10 + e};
Physical Surface("upper back") = Surface In BoundingBox {-rim - e, -rim - e, 18 - e, rim + e, rim + e, 18 + e};
Physical Surface("bore") = Surface In BoundingBox {-bore - e, -bore - e, -e, bore + e, bore + e, 8 + e};
