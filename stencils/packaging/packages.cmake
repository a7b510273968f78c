# Debian packages of what is installed, one for each component: `cmake --workflow --preset package` leaves them in build/package/packages.
# Other generators of CPack (TGZ) pack the same components.
#
# sublimit_package(COMPONENT "summary" "description" [SECTION section] [DEPENDS packages] [RECOMMENDS packages] [SUGGESTS packages]
#                  [ALSO control files]) -- what shared libraries are needed, dpkg-shlibdeps adds.
set(packaging ${CMAKE_CURRENT_LIST_DIR})
set(debian ${PROJECT_BINARY_DIR}/debian)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(debian_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(maintainer_name "sublimit maintainers")
set(maintainer_address maintainers@sublimit.invalid)
if(NOT "$ENV{DEBEMAIL}" STREQUAL "")  # who packs, by the variables of Debian's own tools
  set(maintainer_address "$ENV{DEBEMAIL}")
  if(NOT "$ENV{DEBFULLNAME}" STREQUAL "")
    set(maintainer_name "$ENV{DEBFULLNAME}")
  endif()
endif()
set(maintainer "${maintainer_name} <${maintainer_address}>")

# Documents that Debian wants in each package. The date is SOURCE_DATE_EPOCH, where that is set.
set(ENV{LC_ALL} C)
string(TIMESTAMP debian_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(${packaging}/changelog.in ${debian}/changelog.Debian @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${debian}/changelog COPYONLY)
find_program(GZIP_PROGRAM gzip)
if(GZIP_PROGRAM)
  execute_process(COMMAND ${GZIP_PROGRAM} -9nfk changelog changelog.Debian WORKING_DIRECTORY ${debian} COMMAND_ERROR_IS_FATAL ANY)
endif()

# The sources, as a tarball.
add_custom_target(dist COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION} -DOUT=${PROJECT_BINARY_DIR}
                                                -P ${packaging}/dist.cmake VERBATIM)

set(CPACK_COMPONENTS_ALL "")
function(sublimit_package component summary description)
  cmake_parse_arguments(arg "" "SECTION" "DEPENDS;RECOMMENDS;SUGGESTS;ALSO" ${ARGN})
  string(TOUPPER ${component} name)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_COMPONENT_${name}_DESCRIPTION "${summary}\n${description}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_SECTION "${arg_SECTION}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_PACKAGE_CONTROL_EXTRA "${arg_ALSO}" PARENT_SCOPE)
  foreach(field DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN arg_${field} ", " packages)
    set(CPACK_DEBIAN_${name}_PACKAGE_${field} "${packages}" PARENT_SCOPE)
  endforeach()
  if(GZIP_PROGRAM)
    install(FILES ${packaging}/copyright ${debian}/changelog.Debian.gz ${debian}/changelog.gz
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${component} COMPONENT ${component})
  endif()
endfunction()

install(FILES ${packaging}/linked.spdx DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libsublimit-dev)

sublimit_package(libsublimit-dev "subdivision surfaces as sparse matrices (development files)"
                 "Headers, static libraries, CMake's find_package(sublimit), and\npkg-config's sublimit, sublimit-lib and sublimit-eval."
                 SECTION libdevel
                 DEPENDS libtbb-dev libhwy-dev "libeigen3-dev (>= 3.4)" zlib1g-dev
                 RECOMMENDS libflint-dev libflint-arb-dev libfmt-dev libzip-dev nlohmann-json3-dev
                 SUGGESTS libopenvdb-dev libocct-data-exchange-dev libocct-modeling-algorithms-dev libopenmpi-dev petsc64-dev)
if(TARGET sublimit)
  set(same "sublimit (= ${debian_version})")
  sublimit_package(sublimit "subdivision surfaces and their exact limits (program)"
                   "Refines control meshes, takes limits anywhere, bakes tables, fits, and proves smoothness."
                   SECTION graphics SUGGESTS sublimit-cad sublimit-implicit sublimit-gpu sublimit-mpi)
  if(TARGET sublimit_opencascade)
    sublimit_package(sublimit-cad "STEP and BREP files of subdivision surfaces"
                     "The part of the program that needs OpenCASCADE: sublimit step." SECTION graphics DEPENDS ${same})
  endif()
  if(TARGET sublimit_openvdb)
    sublimit_package(sublimit-implicit "control meshes of implicit surfaces"
                     "The part of the program that needs OpenVDB: sublimit implicit." SECTION graphics DEPENDS ${same})
  endif()
  if(TARGET sublimit_gpu)
    sublimit_package(sublimit-gpu "tables of subdivision surfaces on GPUs"
                     "The part of the program that uses Vulkan or CUDA: sublimit devices,\nsublimit apply --gpu."
                     SECTION graphics DEPENDS ${same} libvulkan1 RECOMMENDS mesa-vulkan-drivers)
  endif()
endif()
if(TARGET sublimit-mpi)
  sublimit_package(sublimit-mpi "limits of one mesh by many processes"
                   "The program sublimit-mpi, for meshes beyond one machine." SECTION graphics DEPENDS openmpi-bin SUGGESTS sublimit)
endif()
if(TARGET sublimit_python)
  get_property(python_minor GLOBAL PROPERTY sublimit_python_minor)
  math(EXPR python_next "${python_minor} + 1")
  sublimit_package(python3-sublimit "subdivision surfaces and their exact limits (Python 3)"
                   "The module sublimit: what the program does, in arrays." SECTION python
                   DEPENDS "python3 (>= 3.${python_minor})" "python3 (<< 3.${python_next})" python3-numpy python3-scipy
                   SUGGESTS python3-torch sublimit-cad sublimit-implicit sublimit-gpu ALSO ${packaging}/python/postinst ${packaging}/python/prerm)
endif()

set(CPACK_GENERATOR DEB CACHE STRING "What cpack makes")
set(CPACK_PACKAGE_NAME sublimit)
set(CPACK_PACKAGE_VENDOR "${maintainer_name}")
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_SOURCE sublimit)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_THREADS 0)
include(CPack)
