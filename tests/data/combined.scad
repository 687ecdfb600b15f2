// Two bodies combined by a boolean (OpenSCAD, lengths in mm): a turned knob and a twisted, tilted star bar that pierces it.
// Neither tessellation knows of the other, so slivers gather where they meet.
// scripts/remake in this folder exports it as combined.stl.

module knob() {
  rotate_extrude($fn = 90) polygon(concat(
    [[0, -46], [26, -46], [30, -42]],
    [for (step = [0 : 22]) [18 + 16 * pow(sin(step * 180 / 22), 2) + 1.2 * sin(step * 97), -40 + step * 3.4]],
    [[15, 40], [0, 44]]));
}

module star_bar() {
  linear_extrude(height = 130, twist = 160, slices = 70, center = true)
    polygon([for (corner = [0 : 19]) let (radius = corner % 2 == 0 ? 13.5 : 8.5) [radius * cos(18 * corner), radius * sin(18 * corner)]]);
}

union() {
  knob();
  translate([3.1, 1.7, -2.3]) rotate([78, 11, 33]) star_bar();
}
