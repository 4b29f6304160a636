# vndf compare: a page with its pictures and tables on the terminal, for ways of drawing normals and for tables;
# wrong words are refused with status 2 and leave nothing behind.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)
set(scene ${OUT}/ball.scene)
file(WRITE ${scene} "film width 40 height 24\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
    "material gold conductor of gold distribution ggx alpha 0.3\nmaterial lamp light radiance 5 5 5\n"
    "sphere centre 0 0 0 radius 1 material gold\nsphere centre 0 2 1 radius 0.2 material lamp\n")
file(WRITE ${OUT}/glass.scene "film width 40 height 24\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
    "material ice dielectric index 1.3 distribution ggx alpha 0.1\nsphere centre 0 0 0 radius 1 material ice\n")
file(WRITE ${OUT}/file.scene "film width 40 height 24\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
    "material m conductor of gold distribution table ${SOURCE}/tables/student-t-2.5.vndf\n"
    "sphere centre 0 0 0 radius 1 material m\n")

# Files of the page are there, and the page mentions those that are pictures.
function(expect_files folder)
    file(READ ${OUT}/${folder}/index.html page)
    foreach(name IN LISTS ARGN)
        string(FIND "${page}" "${name}" at)
        if(NOT EXISTS ${OUT}/${folder}/${name} OR (at EQUAL -1 AND name MATCHES "png$"))
            message(SEND_ERROR "${folder} has no ${name}")
        endif()
    endforeach()
endfunction()

answers(0 "| bounded | " compare ${scene} page --spp 8)
expect_files(page index.html points.csv reference.pfm crops.png reference-film.png visible-time.png
    visible-time.pfm all-samples.png bounded-error.png)
answers(0 "The reference was read" compare ${scene} page --spp 4 --samplers all,visible
    --reference page/reference.pfm)
answers(0 "replaced page/index.html" compare ${scene} page --spp 4 --samplers all,visible
    --reference page/reference.pfm)
answers(0 "| 2 KiB | " compare ${scene} tables --spp 4 --tables 2048,3000 --threads 1)
expect_files(tables 2-kib-time.png 3000-bytes-changes.png closed-forms-changes.png)
answers(0 "Without bounded" compare glass.scene glass --spp 4) # for the page; told on the terminal, too
answers(0 "example:" compare --help)

answers(2 "SCENE DIR" compare ${scene})
answers(2 "did you mean 'bounded'?" compare ${scene} no --samplers visible,bouned)
answers(2 "stands there twice" compare ${scene} no --samplers visible,visible)
answers(2 "2048 stands there twice" compare ${scene} no --tables 2048,2048)
answers(2 "two comparisons" compare ${scene} no --samplers visible --tables 2048)
answers(2 "no whole number" compare ${scene} no --tables 2048.5)
answers(2 "--tables" compare ${scene} no --tables 100)
answers(2 "cannot build anew" compare file.scene no --tables 2048)
answers(2 "material 'ice'" compare glass.scene no --samplers visible,bounded)
answers(2 "it is 40 x 24 pixels" compare ${scene} no --spp 4 --width 20 --reference page/reference.pfm)
answers(2 "no.pfm" compare ${scene} no --spp 4 --reference no.pfm)
answers(2 "no.scene" compare no.scene no)
answers(2 "has files in it" compare ${scene} ${OUT})
answers(2 "--spp" compare ${scene} no --spp 1)
file(GLOB left ${OUT}/no* ${OUT}/*/*.tmp*)
if(left)
    message(SEND_ERROR "left behind: ${left}")
endif()
