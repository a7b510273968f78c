// A table for the next two programs.
#include <sublimit/sublimit.h>

int main(int, char** arguments) {
  sublimit::bake(sublimit::read_mesh(arguments[1]), "catmull-clark", {.levels = 3}).save("table.safetensors");
}
