# `vndf explore` writes one page that asks the network for nothing and is the same each time, whatever its tables' names
# are; it refuses wrong use; and in a headless Chromium, which compiles its shaders, what the page draws and measures is
# right: the density integrates to 1, drawn normals have the mean that it says, none is turned away, the spheres have
# light on them. Without WebGL2 it says so. Chromium takes a quarter of a minute for a setting where it has no GPU:
# LONG=ON (long_explore) has four of them, and what engines make of them in one pass is near what samples say; else
# there is one, and glslang compiles the shader of engines.
cmake_minimum_required(VERSION 3.16)

include(${SOURCE}/tests/harness/program.cmake)

set(tables ${SOURCE}/tables)
set(odd_name "a&b.vndf")
configure_file(${tables}/student-t-2.5-small.vndf "${OUT}/${odd_name}" COPYONLY)

# ---- the page -----------------------------------------------------------------------------------

set(engines "")
if(LONG)
    set(engines --engines 32 -q)
endif()
foreach(page one two)
    answers(0 "" explore ${tables}/hazy.vndf ${odd_name} ${tables}/student-t-2.5.vndf ${engines} -o ${page}.html)
endforeach()
file(SHA256 ${OUT}/one.html one)
file(SHA256 ${OUT}/two.html two)
expect("the same tables make two pages" one STREQUAL two)
file(READ ${OUT}/one.html text)
has(text " data-tv=\"0.00038\">hazy</option>")
has(text ">a&amp;b</option>")
answers(0 "" explore ${tables}/hazy.vndf --engines 4 -q -o engines.html)
file(READ ${OUT}/engines.html engines)
has(engines "What an engine makes of it in one pass")
string(REGEX MATCH "id=\"baked\">\n[^<]*" baked "${engines}")
string(REGEX REPLACE "[^A-Za-z0-9+/=]" "" baked "${baked}")
string(LENGTH "${baked}" length) # 3 distributions of 16 texels with 10 numbers and 256 taps of 4, 4 bytes each
expect("the page has ${length} digits of baked tables" length GREATER 18900 AND length LESS 19020)
find_program(GLSLANG glslangValidator)
if(GLSLANG)
    set(shader "#version 310 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;
precision highp samplerCube;\nuniform sampler2D numbers;
#define VNDF_FETCH(i) texelFetch(numbers, ivec2(i, 0), 0).r\n")
    answers(0 "" export ${tables}/hazy.vndf --language glsl --buffer engines.f32 -o engines.glsl)
    foreach(file ${OUT}/engines.glsl ${SOURCE}/tools/export/page/surface.glsl ${SOURCE}/tools/export/page/light.glsl
            ${SOURCE}/tools/export/page/engines.glsl ${SOURCE}/tools/export/page/pixels.glsl)
        file(READ ${file} part)
        string(APPEND shader "${part}")
    endforeach()
    string(REPLACE "out vec4 sum;" "layout(location = 0) out vec4 sum;" shader "${shader}")
    file(WRITE ${OUT}/engines.frag "${shader}")
    execute_process(COMMAND ${GLSLANG} ${OUT}/engines.frag RESULT_VARIABLE status OUTPUT_VARIABLE output)
    expect("engines.glsl: ${output}" status EQUAL 0)
endif()
has(text "const int VNDF_STUDENT_T_2_5 = ")
has(text "vndf_sampled vndf_sample(vndf_view view, float w1, float w2) {")
foreach(word "{{" "a&b")
    string(FIND "${text}" "${word}" at)
    expect("the page has '${word}'" at EQUAL -1)
endforeach()
foreach(word "http:" "https:" "src=" "url(h" "url(/" "url('" "@import" "import(" "XMLHttp" "<link" "WebSocket")
    string(FIND "${text}" "${word}" at)
    expect("the page has '${word}', which may ask the network" at EQUAL -1)
endforeach()

# The numbers are those of the kernel's buffer.
find_program(BASE64 base64)
if(BASE64)
    answers(0 "" export ${tables}/hazy.vndf ${odd_name} ${tables}/student-t-2.5.vndf --language glsl
        --buffer numbers.f32 -o kernel.glsl)
    string(REGEX MATCH "id=\"numbers\">\n([^<]*)\n</script>" numbers "${text}")
    file(WRITE ${OUT}/numbers.base64 "${CMAKE_MATCH_1}")
    execute_process(COMMAND ${BASE64} -d ${OUT}/numbers.base64 OUTPUT_FILE ${OUT}/numbers RESULT_VARIABLE status)
    file(SHA256 ${OUT}/numbers one)
    file(SHA256 ${OUT}/numbers.f32 two)
    expect("the numbers of the page are not those of vndf export" one STREQUAL two)
endif()

# ---- wrong use ----------------------------------------------------------------------------------

# Files are read as vndf export reads them.
answers(2 "-o PAGE.html is missing" explore ${tables}/hazy.vndf)
answers(2 "missing.vndf" explore missing.vndf -o none.html)
answers(2 "--engines" explore ${tables}/hazy.vndf --engines 3 -o none.html)
answers(2 "--language" explore ${tables}/hazy.vndf --language glsl -o none.html)
answers(2 "no-such-folder" explore ${tables}/hazy.vndf -o no-such-folder/none.html)
expect("a refused page was written" NOT EXISTS ${OUT}/none.html)
answers(0 "example: vndf explore" explore --help)

# ---- in a browser -------------------------------------------------------------------------------

find_program(CHROMIUM NAMES chromium chromium-browser google-chrome)
if(SANITIZE)
    message("the page is not drawn: that would be the same without sanitizers (${SANITIZE})")
    return()
elseif(NOT CHROMIUM)
    message("SKIPPED: no Chromium here to draw the page with")
    return()
endif()

# browse(RESULT OPTIONS...): what a headless Chromium prints.
function(browse result)
    execute_process(
        COMMAND ${CHROMIUM} --headless --no-sandbox --hide-scrollbars --user-data-dir=${OUT}/profile
            --virtual-time-budget=1000 --window-size=520,700 ${ARGN}
        OUTPUT_VARIABLE output ERROR_QUIET TIMEOUT 250)
    set(${result} "${output}" PARENT_SCOPE)
endfunction()
set(software --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader)

# Without WebGL2 the page says so; and each step of the keyboard moves a slider of roughness by one step, from end to
# end: a setting that is rounded and written back must not take the step back.
string(CONCAT steps "<script>listen(() => {});"
    "const slider = byId('alpha-x'); let stuck = 0; slider.value = 0; for (let i = 1; i <= 200; i++) {"
    "slider.stepUp(); slider.dispatchEvent(new Event('input'));"
    "stuck += Math.abs(Number(slider.value) - i / 200) > 1e-6; }"
    "document.body.dataset.stuck = `\${stuck} of 200, alpha \${settings.alpha[0]}`;</script></body>")
string(REPLACE "</body>" "${steps}" stepping "${text}")
file(WRITE ${OUT}/stepping.html "${stepping}")
browse(dom --disable-3d-apis --dump-dom file://${OUT}/stepping.html)
if(NOT dom MATCHES "</html>")
    message("SKIPPED: the Chromium here does not run")
    return()
endif()
expect("the page does not say that WebGL2 is missing" dom MATCHES "This browser has no WebGL2")
string(REGEX MATCH "data-stuck=\"[^\"]*\"" stuck "${dom}")
expect("the keyboard cannot move a slider: '${stuck}'" stuck STREQUAL "data-stuck=\"0 of 200, alpha 1\"")

# between(LOW NAME HIGH): a number that the page measured.
macro(between low name high)
    set(value "nothing")
    if(measured MATCHES "\"${name}\":([-+.0-9e]+)")
        set(value ${CMAKE_MATCH_1})
    endif()
    expect("${settings}: ${name} is ${value}, not from ${low} to ${high}" value GREATER_EQUAL ${low} AND
        value LESS_EQUAL ${high})
endmacro()

set(all_settings
    "a=hazy&b=ggx&alpha=0.3&theta=60&frames=2"
    "a=student-t-2.5&b=beckmann&alpha=0.05,0.4&turn=30&theta=80&median=1&light=studio&material=glass&frames=2"
    "a=student-t-2.5&b=beckmann&alpha=0.3&theta=0&light=lamp&material=red&frames=1"
    "a=hazy&b=ggx&alpha=0.3&light=sky&frames=48")
if(NOT LONG)
    list(SUBLIST all_settings 0 1 all_settings)
endif()
foreach(settings IN LISTS all_settings)
    browse(dom ${software} --dump-dom "file://${OUT}/one.html#${settings}")
    string(REGEX MATCH "data-measured=\"[^\"]*\"" measured "${dom}")
    string(REPLACE "&quot;" "\"" measured "${measured}")
    string(REGEX MATCH "id=\"trouble\"[^<]*" trouble "${dom}")
    if(NOT measured)
        message(FATAL_ERROR "${settings}: nothing was drawn: ${trouble}")
    endif()
    between(1 drawn 48)
    between(0 error 0)
    foreach(which a b)
        between(0.99 ${which}_whole 1.01)
        between(0.99 ${which}_true_whole 1.01)
        between(0.999 ${which}_facing_to_density 1.001)
        between(0 ${which}_faults 0)
        between(0 ${which}_off 1e-4)
        between(0.5 ${which}_kept 1)
        between(0.005 ${which}_light 2)
        between(0.02 ${which}_spread 2)
        between(0 ${which}_light_faults 0)
    endforeach()
    if(settings MATCHES "frames=48") # fewer samples a pixel are too grainy
        between(0.001 area_error 0.08)
        between(0.001 sky_error 0.08)
    endif()
    if(settings MATCHES "b=ggx") # their albedo by quadrature
        between(0.9841 a_kept 0.9881)
        between(0.8196 b_kept 0.8236)
    endif()
endforeach()
