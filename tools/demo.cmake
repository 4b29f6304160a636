# The demo: tables from a formula that nobody has a sampler for, from a CSV and from a measured material; each is built,
# printed with its certificate and drawn; the first is checked as well, which takes seconds.
#
#   cmake -DVNDF=path/of/vndf -DOUT=folder -P tools/demo.cmake
cmake_minimum_required(VERSION 3.16)

file(MAKE_DIRECTORY ${OUT})
file(COPY ${CMAKE_CURRENT_LIST_DIR}/../tables/example.csv DESTINATION ${OUT}) # so that the table names it without a path

# To stdout like the program's own lines, so that they stay in order in a log.
function(say text)
    execute_process(COMMAND ${CMAKE_COMMAND} -E echo "${text}")
endfunction()

# Runs `vndf ...`, prints the command as one would type it, and ends the demo if it fails.
function(vndf)
    string(REGEX REPLACE "([^;]*[^-+.,:/=_A-Za-z0-9;][^;]*)" "'\\1'" shown "${ARGN}")
    list(JOIN shown " " shown)
    say("\n$ vndf ${shown}")
    execute_process(COMMAND ${VNDF} ${ARGN} WORKING_DIRECTORY ${OUT} RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "the command above ended with exit status ${status}")
    endif()
endfunction()

say("1. A formula: a distribution of slopes with rings, which has no name and no published sampler")
vndf(build --slope "exp(-3*r)*(1+0.8*cos(6*r))" -o rings.vndf)
vndf(check rings.vndf --samples 300000)
vndf(plot rings.vndf -o rings.svg)

say("\n2. A curve: angle and density in a CSV, as a gloss meter gives them")
vndf(build --csv example.csv -o gloss.vndf)
vndf(plot gloss.vndf -o gloss.svg)

say("\n3. A measured material: the published fit of alum-bronze, and the same stretched along y")
vndf(build --family sgd:alum-bronze/r -o alum-bronze.vndf)
vndf(plot alum-bronze.vndf -o alum-bronze.svg)
vndf(plot alum-bronze.vndf --alpha 1,3 --theta 0,60,85 -o alum-bronze-brushed.svg)
vndf(sample alum-bronze.vndf --theta 60 -n 10 -o -)

say("\nTables, and figures of density and samples, are in ${OUT}")
