# Renders a tiny scene on Oclgrind's simulated device, which sees every read and write of every work-item.
# cmake -DOCLGRIND=… -DWEDGE=… -DSCENE=… -DOUT=folder -DOPTIONS=… -P run.cmake
file(MAKE_DIRECTORY ${OUT})
set(log ${OUT}/oclgrind.log)
file(REMOVE ${log})
# -cl-opt-disable: LLVM's optimiser makes instructions that Oclgrind 21.10 does not know; no cache, or a program
# built with other options might come from there.
execute_process(
    COMMAND ${CMAKE_COMMAND} -E env WEDGE_CACHE=0
            ${OCLGRIND} --data-races --build-options -cl-opt-disable --log ${log}
            ${WEDGE} render ${SCENE} --device Oclgrind -o ${OUT}/tiny.exr ${OPTIONS}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "the render failed (${result}):\n${output}")
endif()
set(found "")
if(EXISTS ${log})
    file(READ ${log} found)
endif()
string(STRIP "${found}" found)
string(SUBSTRING "${found}" 0 2000 found)
if(NOT found STREQUAL "")
    message(FATAL_ERROR "Oclgrind found:\n${found}")
endif()
if(NOT output MATCHES "Oclgrind")
    message(FATAL_ERROR "the render did not run on Oclgrind's device:\n${output}")
endif()
