# OpenCASCADE's DRAW: reads a boundary representation, tessellates it as CAD systems do for display, writes a binary STL.
# Environment: IN (.brep), OUT (.stl), DEFLECTION (largest distance from the surface, mm), ANGLE (between neighbouring normals, degrees).
pload MODELING XDE
restore $env(IN) body
incmesh body $env(DEFLECTION) -angular $env(ANGLE)
writestl body $env(OUT) 1
exit
