// A bar of 1 x 0.1 x 0.06 m, 3 x 2 x 1 hexahedra of 20 nodes.
Point(1) = {0, -0.05, -0.03};
across[] = Extrude {0, 0.1, 0} { Point{1}; Layers{2}; };
face[] = Extrude {0, 0, 0.06} { Line{across[1]}; Layers{1}; Recombine; };
bar[] = Extrude {1, 0, 0} { Surface{face[1]}; Layers{3}; Recombine; };
Physical Volume("bar") = {bar[1]};
Physical Surface("root") = {face[1]};
Physical Surface("tip") = {bar[0]};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.SaveGroupsOfNodes = 1;
