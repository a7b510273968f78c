// Texture coordinates, refined with the mesh.
#include <sublimit/sublimit.h>

int main(int, char** arguments) {
  sublimit::Mesh mesh = sublimit::read_mesh(arguments[1]);
  mesh.face_varying_interpolation = sublimit::FaceVaryingInterpolation::boundaries;
  const sublimit::Mesh fine = sublimit::refine(mesh, "catmull-clark", 2);
  if (fine.face_varying.empty()) return 1;
  sublimit::write_mesh("fine.obj", fine);
}
