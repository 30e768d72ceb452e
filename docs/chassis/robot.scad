// Chassis of a Wi-Fi robot: plate, lid and two feet, printed flat and without supports. Lengths in mm.
//
//     openscad -o plate.stl -D 'part="plate"' docs/chassis/robot.scad      also lid, foot, front
//
// The origin is on the mat, midway between the wheels; y points ahead. docs/kit.md has the steps.

part = "assembly";  // plate, lid, foot, front (its foot), or assembly: the whole robot, for a look and for measuring

diameter = 95;      // of plate and lid: the robot of the games
base = 82;          // between the middles of the wheels
wheel_d = 32;       // wheel of a gear motor N20
wheel_w = 7;
lid_top = 70;       // of the marker above the mat
thick = 3;          // of plate and lid
motor = [24, 12, 10];   // gear motor N20 without its shaft: along the axle, ahead, up
bracket_holes = 18; // between the screws M2 of its bracket
caster_h = 10;      // ball caster of 3/8 inch
caster_holes = 13.5;
caster_y = 33;      // one behind the wheels, on the mat; one ahead, above it, for the robot to brake onto
lift = 0.8;         // of the front caster above the mat
post_r = 4;
posts = [[13, 38.5], [-13, 38.5], [0, -40]];   // beside the paper of a marker, 66.7 wide

axle = wheel_d / 2;
plate_z = axle + motor[2] / 2;          // underside of the plate: motors hang below it
post_h = lid_top - thick - plate_z - thick;
foot_h = plate_z - caster_h;
gap = 1.5;                              // between a wheel and its window

assert(base / 2 - wheel_w / 2 - 1 >= motor[0], "base: two motors do not fit between the wheels");
assert(max([for (p = posts) norm(p)]) + post_r <= diameter / 2, "diameter: the posts of the lid stand beside the plate");
assert(foot_h - lift >= 1, "caster_h: the casters leave no room for their feet below the plate");
assert(post_h >= 13, "lid_top: the posts of the lid are too short for its screws");

$fn = 96;

module screw_hole(d, h) { translate([0, 0, -1]) cylinder(d = d, h = h + 2, $fn = 32); }

module wheel_window(side) {
    inner = base / 2 - wheel_w / 2 - gap;
    translate([side > 0 ? inner : -inner - diameter, -wheel_d / 2 - 2, -1]) cube([diameter, wheel_d + 4, thick + 2]);
}

module bracket_slots(side) {
    x = side * (base / 2 - wheel_w / 2 - 7.5);
    for (y = [-1, 1]) hull() for (dx = [-1.5, 1.5])
        translate([x + dx, y * bracket_holes / 2, 0]) screw_hole(2.3, thick);
}

module plate() {
    difference() {
        union() {
            cylinder(d = diameter, h = thick);
            for (p = posts) translate([p[0], p[1], 0]) cylinder(r = post_r, h = thick + post_h, $fn = 48);
        }
        for (side = [-1, 1]) { wheel_window(side); bracket_slots(side); }
        for (p = posts) translate([p[0], p[1], thick + post_h - 12]) cylinder(d = 2.6, h = 13, $fn = 24);
        for (x = [-1, 1]) for (y = [-1, 1])
            translate([x * caster_holes / 2, y * caster_y, 0]) screw_hole(2.4, thick);
        for (x = [-22, 22]) for (y = [-20, 20])     // straps of the cells
            translate([x - 1.75, y - 3, -1]) cube([3.5, 6, thick + 2]);
        translate([0, 22, 0]) screw_hole(9, thick);     // wires
    }
}

module lid() {
    difference() {
        cylinder(d = diameter, h = thick);
        for (p = posts) translate([p[0], p[1], 0]) {
            screw_hole(3.4, thick);
            translate([0, 0, thick - 1.7]) cylinder(d1 = 3.4, d2 = 6.8, h = 1.71, $fn = 32);
        }
        translate([0, 41, thick - 0.6]) linear_extrude(1) polygon([[-4, -2], [4, -2], [0, 4]]);   // ahead
    }
}

module foot(high) {
    difference() {
        hull() for (x = [-1, 1]) translate([x * caster_holes / 2, 0, 0]) cylinder(d = 9, h = high, $fn = 48);
        for (x = [-1, 1]) translate([x * caster_holes / 2, 0, 0]) screw_hole(2.4, high);
    }
}

module wheels() {
    for (side = [-1, 1]) translate([side * base / 2, 0, axle]) rotate([0, 90, 0])
        cylinder(d = wheel_d, h = wheel_w, center = true);
}

module motors() {
    for (side = [-1, 1]) {
        inner = base / 2 - wheel_w / 2 - 1;
        translate([side > 0 ? inner - motor[0] : -inner, -motor[1] / 2, plate_z - motor[2] - 0.05]) cube(motor);
    }
}

module assembly() {
    translate([0, 0, plate_z]) plate();
    translate([0, 0, lid_top - thick + 0.01]) lid();
    for (y = [-1, 1]) translate([0, y * caster_y, y > 0 ? lift : 0]) {
        translate([0, 0, plate_z - foot_h - 0.05]) foot(foot_h - (y > 0 ? lift : 0));
        translate([0, 0, caster_h / 2]) sphere(d = caster_h - 0.2);
    }
    wheels();
    motors();
}

if (part == "plate") plate();
else if (part == "lid") lid();
else if (part == "foot") foot(foot_h);
else if (part == "front") foot(foot_h - lift);
else assembly();
