// A box of 16 x 4 x 2 hexahedra of 20 nodes: radius, chord and thickness of a blade, -1 ... 1 across.
Point(1) = {0, -1, -1};
chord[] = Extrude {0, 2, 0} { Point{1}; Layers{4}; };
face[] = Extrude {0, 0, 2} { Line{chord[1]}; Layers{2}; Recombine; };
box[] = Extrude {1, 0, 0} { Surface{face[1]}; Layers{16}; Recombine; };
Physical Volume("blade") = {box[1]};
Physical Surface("root") = {face[1]};
Physical Surface("tip") = {box[0]};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
Mesh.SaveGroupsOfNodes = 1;
