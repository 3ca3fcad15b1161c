// A block of 40 x 20 x 10 mm with a bore of 8 mm diameter; bracket.step and bracket.brep are this geometry.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 40, 20, 10};
Cylinder(2) = {20, 10, -1, 0, 0, 12, 4};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
