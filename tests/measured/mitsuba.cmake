# A .bsdf of `vndf export --rgl` in Mitsuba 3's plugin `measured`, unmodified: its values are those of GGX in closed
# form, its samples follow its own density, and their weights are value over density; also in spectra.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

if(NOT PYTHON)
    message("SKIPPED: no Python was found (-DVNDF_PYTHON names one)")
    return()
endif()
execute_process(COMMAND ${PYTHON} -c "import numpy, mitsuba" RESULT_VARIABLE absent OUTPUT_QUIET ERROR_QUIET)
if(absent)
    message("SKIPPED: ${PYTHON} has no mitsuba with numpy (pip install mitsuba numpy)")
    return()
endif()
answers(0 "" export ggx --rgl --alpha 0.5 --f0 1,0.5,0.25 -o rough.bsdf)
answers(0 "" export ggx --rgl --alpha 0.05 -o smooth.bsdf)
answers(0 "" export ggx --rgl --alpha 0.3 --wavelengths 400,600,800 --f0 0.25,0.5,1 -o spectral.bsdf)
execute_process(COMMAND ${PYTHON} ${SOURCE}/tests/measured/mitsuba_check.py WORKING_DIRECTORY ${OUT}
    RESULT_VARIABLE bad)
if(bad)
    message(FATAL_ERROR "what Mitsuba evaluates or draws is not what was written")
endif()
