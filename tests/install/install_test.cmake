# Installs into an empty folder, moves that folder (an installed package must not know where it was put),
# then configures, builds and runs a project that uses it.
function(run step)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${step} failed (${result}):\n${output}")
    endif()
    message(STATUS "${step}: done\n${output}")
endfunction()

set(prefix ${SCRATCH}/moved)
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
run("install" ${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${SCRATCH}/prefix)
file(RENAME ${SCRATCH}/prefix ${prefix})

foreach(pattern bin/wedge lib*/libwedge.a lib*/wedge/libwedge_codec-*.so include/wedge/scene.hpp include/wedge/shared/scene.h
        share/wedge/scenes/demo.json share/doc/wedge/LICENSE)
    file(GLOB found ${prefix}/${pattern})
    if(NOT found)
        message(FATAL_ERROR "not installed: ${pattern}")
    endif()
endforeach()

run("installed program" ${prefix}/bin/wedge --version)
run("installed program writes images" ${prefix}/bin/wedge render ${prefix}/share/wedge/scenes/grids.json
    --spp 1 --size 8x8 --bounces 0 -o ${SCRATCH}/program.png)
run("configure" ${CMAKE_COMMAND} -S ${CONSUMER} -B ${SCRATCH}/build -G ${GENERATOR}
    -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=${CONFIG}
    -DCMAKE_CXX_FLAGS=${FLAGS})
run("build" ${CMAKE_COMMAND} --build ${SCRATCH}/build --config ${CONFIG})
run("run" ${SCRATCH}/build/consumer ${prefix}/share/wedge/scenes/grids.json ${SCRATCH}/consumer.exr)
