# The sources as sublimit-VERSION.tar.gz: cmake -DSOURCE=DIR -DVERSION=x.y.z -DOUT=DIR -P dist.cmake
# The same sources give the same bytes. Of a checkout those files that git knows, as they are now; of other trees all. Times of files are
# SOURCE_DATE_EPOCH; without, that of the last commit, or of CHANGELOG.md. REUSE wants licences in a folder: it is added.
include(${CMAKE_CURRENT_LIST_DIR}/sources.cmake)
sublimit_sources(${SOURCE} files)
set(epoch "$ENV{SOURCE_DATE_EPOCH}")
if(NOT epoch AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND git -c safe.directory=* log -1 --format=%ct WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE epoch
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(NOT epoch)
  file(TIMESTAMP ${SOURCE}/CHANGELOG.md epoch %s UTC)
endif()
if(NOT epoch MATCHES "^[0-9]+$")
  message(FATAL_ERROR "SOURCE_DATE_EPOCH is '${epoch}'; it should be seconds since 1970")
endif()

set(name sublimit-${VERSION})
set(licences ${OUT}/dist)
file(MAKE_DIRECTORY ${licences}/LICENSES)
file(COPY_FILE ${SOURCE}/LICENSE ${licences}/LICENSES/Apache-2.0.txt)
list(JOIN files "\n" lines)
file(WRITE ${licences}/files "${lines}\n")
set(tar ${OUT}/${name}.tar)
set(ENV{LC_ALL} C)
execute_process(COMMAND tar --create --file ${tar} --format=gnu --owner=0 --group=0 --numeric-owner --mtime=@${epoch}
                        --mode=u+rwX,go+rX,go-w --transform=s,^,${name}/, --no-recursion
                        --directory=${SOURCE} --verbatim-files-from --files-from=${licences}/files
                        --directory=${licences} LICENSES/Apache-2.0.txt
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip -9nf ${tar} COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE_RECURSE ${licences})
message(STATUS "${tar}.gz")
