// One face of 600 x 400 mm; square.step is this geometry.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 600, 400};
