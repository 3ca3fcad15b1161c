// A plate of 203 x 203 x 1.37 mm with a rib of 6.35 x 12.7 mm under its middle, in bricks; z = 0 is the plate's middle.
side = 203; thickness = 1.37; width = 6.35; height = 12.7;
along = 24; across = 12; deep = 2; // elements along the rib, across each half of the plate, over the rib's height
low = -thickness / 2;

Point(1) = {0, 0, low};
Point(2) = {(side - width) / 2, 0, low};
Point(3) = {(side + width) / 2, 0, low};
Point(4) = {side, 0, low};
For i In {1 : 3}
  Line(i) = {i, i + 1};
EndFor
Transfinite Curve {1, 3} = across + 1;
Transfinite Curve {2} = 2;

// the three strips of the lower face: left half, rib, right half
For i In {1 : 3}
  strip[] = Extrude {0, side, 0} { Line{i}; Layers{along}; Recombine; };
  strips[i - 1] = strip[1];
EndFor

For i In {0 : 2}
  up[] = Extrude {0, 0, thickness} { Surface{strips[i]}; Layers{1}; Recombine; };
  body[] += {up[1]};
EndFor
rib[] = Extrude {0, 0, -height} { Surface{strips[1]}; Layers{deep}; Recombine; };
body[] += {rib[1]};

e = 1e-3;
sides[] = Surface In BoundingBox {-e, -e, -20, e, side + e, 20};
sides[] += Surface In BoundingBox {side - e, -e, -20, side + e, side + e, 20};
sides[] += Surface In BoundingBox {-e, -e, -20, side + e, e, 20};
sides[] += Surface In BoundingBox {-e, side - e, -20, side + e, side + e, 20};
Physical Surface("sides") = {sides[]};
Physical Volume("body") = {body[]};
