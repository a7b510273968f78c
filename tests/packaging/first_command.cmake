# README's first command on a machine that has nothing, to the end of the configuration: cmake -DSOURCE=DIR -DBUILD=DIR -DVERSION=x.y.z -P
# first_command.cmake. As root, with a network. The sources come as the tarball, so that not even git is there.
include(${CMAKE_CURRENT_LIST_DIR}/../cmake/Run.cmake)
set(root ${BUILD}/first_command)
file(REMOVE_RECURSE ${root})
run(mmdebstrap --variant=minbase bookworm ${root})
run(${CMAKE_COMMAND} -DSOURCE=${SOURCE} -DVERSION=${VERSION} -DOUT=${root} -P ${SOURCE}/stencils/packaging/dist.cmake)
run(chroot ${root} sh -ec "tar xf sublimit-${VERSION}.tar.gz && cd sublimit-${VERSION} && unset HOME && .ci/install-deps && cmake --preset release")
file(REMOVE_RECURSE ${root})
