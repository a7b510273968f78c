# Uses the packages in /packages in a root that has nothing else, and looks that they leave nothing: sh -e in_root.sh
export DEBIAN_FRONTEND=noninteractive LC_ALL=C PATH=/usr/sbin:/usr/bin:/sbin:/bin
unset HOME
cd /uses
mount -t proc proc /proc 2>/dev/null || true
apt-get update -qq
# What they need, and what builds with them, comes first: what is compared is with that and without us.
for package in /packages/*.deb; do
  needs=$(dpkg-deb -f "$package" Depends Recommends | sed 's/^[A-Za-z]*: //' | tr ',' '\n' | sed 's/^ *//' | grep -v '^sublimit' | paste -sd ,)
  apt-get satisfy -y -qq --no-install-recommends "$needs" >/dev/null
done
apt-get install -y -qq --no-install-recommends g++ cmake make pkg-config >/dev/null
everything() {
  find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /uses -o -path /packages -o -path /tmp -o -path /var/log -o -path /var/cache \
    -o -path /var/lib/dpkg \) -prune -o -print | sort
}
everything > /packages/before
dpkg -i /packages/*.deb >/dev/null

echo "== the program"
sublimit demo pot --quiet
printf 'v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n' > cube.obj
test -s /usr/share/man/man1/sublimit.1.gz
test -s /usr/share/man/man1/sublimit-refine.1.gz
test -s /usr/share/bash-completion/completions/sublimit
test -s /usr/share/zsh/vendor-completions/_sublimit
test -s /usr/share/fish/vendor_completions.d/sublimit.fish
echo "== parts that are loaded"
sublimit step cube.obj -s catmull-clark -o cube.step
printf '{"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1}' > ball.json
sublimit implicit ball.json -o ball.obj
sublimit devices
sublimit bake cube.obj -s catmull-clark -l 2 --precision float -o cube.safetensors
# Mesa keeps what it compiled in a cache at home, which is not ours to remove.
export MESA_SHADER_CACHE_DISABLE=true
if sublimit devices --json | grep -q '"number"'; then sublimit apply cube.safetensors cube.obj --gpu -o on_gpu.obj; fi
echo "== many processes"
mpirun --allow-run-as-root --oversubscribe -n 2 sublimit-mpi bake cube.obj -s catmull-clark -l 2 -o shards
echo "== Python"
python3 -c "import sublimit; print(sublimit.__version__, sublimit.limit(sublimit.read('cube.obj'), 'catmull-clark').points[0])"
echo "== C++ by find_package, and by pkg-config"
mkdir -p by_cmake
cat > by_cmake/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(uses LANGUAGES CXX)
find_package(sublimit CONFIG REQUIRED COMPONENTS report)
add_executable(limits ../limits.cpp)
target_link_libraries(limits PRIVATE sublimit::sublimit)
END
cmake -S by_cmake -B by_cmake/build -DCMAKE_CXX_FLAGS=-O0 >/dev/null
cmake --build by_cmake/build >/dev/null
by_cmake/build/limits cube.obj > by_cmake.txt
g++ -std=c++20 -O0 limits.cpp -o limits $(pkg-config --cflags --libs sublimit)
./limits cube.obj | cmp - by_cmake.txt
echo "== C by pkg-config"
printf 'int use_from_c(void);\nint main(void) { return use_from_c(); }\n' > main.c
gcc main.c own_table.c -o own_table $(pkg-config --cflags --libs sublimit-eval)
./own_table

echo "== removed"
names=$(for package in /packages/*.deb; do dpkg-deb -f "$package" Package; done)
dpkg --purge $names >/dev/null
everything > /packages/after
diff /packages/before /packages/after
