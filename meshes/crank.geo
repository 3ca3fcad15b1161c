// A crank of 60 mm throw with counterweight; crank.step is this geometry. Millimetres, shaft along z.
SetFactory("OpenCASCADE");
throw = 60;
// web: the tangents to the circles of both ends
hub = 32; boss = 22; half = 9;
c = (hub - boss) / throw; s = Sqrt(1 - c * c);
Cylinder(1) = {0, 0, -half, 0, 0, 2 * half, hub};
Cylinder(2) = {throw, 0, -half, 0, 0, 2 * half, boss};
Point(1001) = {hub * c, hub * s, -half};
Point(1002) = {throw + boss * c, boss * s, -half};
Point(1003) = {throw + boss * c, -boss * s, -half};
Point(1004) = {hub * c, -hub * s, -half};
Line(1001) = {1001, 1002}; Line(1002) = {1002, 1003}; Line(1003) = {1003, 1004}; Line(1004) = {1004, 1001};
Curve Loop(1001) = {1001, 1002, 1003, 1004};
Plane Surface(1001) = {1001};
web[] = Extrude {0, 0, 2 * half} { Surface{1001}; };
// counterweight: a half disc on the other side
Cylinder(5) = {0, 0, -half, 0, 0, 2 * half, 62, 2 * Pi / 3};
Rotate {{0, 0, 1}, {0, 0, 0}, 2 * Pi / 3} { Volume{5}; }
// ends of full length
Cylinder(6) = {0, 0, -20, 0, 0, 40, hub};
Cylinder(7) = {throw, 0, -15, 0, 0, 30, boss};
BooleanUnion(10) = { Volume{1}; Delete; }{ Volume{2, web[1], 5, 6, 7}; Delete; };
Cylinder(11) = {0, 0, -21, 0, 0, 42, 16};
Cylinder(12) = {throw, 0, -16, 0, 0, 32, 11};
BooleanDifference(20) = { Volume{10}; Delete; }{ Volume{11, 12}; Delete; };
