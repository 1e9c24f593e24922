# The command-line program, `wedge`.
file(GLOB cli_sources CONFIGURE_DEPENDS host/cli/*.cpp)
add_executable(wedge_program ${cli_sources})
set_target_properties(wedge_program PROPERTIES OUTPUT_NAME wedge)
target_link_libraries(wedge_program PRIVATE wedge wedge_options wedge_dep_glm wedge_dep_fmt
    wedge_dep_json wedge_dep_cli11 wedge_dep_opencl_hpp)
