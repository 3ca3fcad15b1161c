// A plate of 0.6 x 0.4 with 6 x 4 quadrilaterals: the same as `plates: {deck: {corners: ..., elements: [6, 4]}}`.
Point(1) = {0, 0, 0};
Point(2) = {0.6, 0, 0};
Point(3) = {0.6, 0.4, 0};
Point(4) = {0, 0.4, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 7;
Transfinite Curve {2, 4} = 5;
Transfinite Surface {1} = {1, 2, 3, 4};
Recombine Surface {1};
Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Surface("deck") = {1};
