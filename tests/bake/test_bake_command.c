/* `vndf bake` writes the tables it is asked for in the forms it is asked for, the same bytes twice, and a page. It ends
 * with a verdict, which doubts a table that is far off. */
#include "harness/run_program.h"

static void test_form(const char *name, size_t whole, const char begins[8])
{
    size_t size;
    char *bytes = run_file(name, &size);
    TEST(bytes && size == whole && memcmp(bytes, begins, 8) == 0);
    free(bytes);
}

int main(void)
{
    char folder[] = "bake.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    run_line(0, "largest error", "vndf bake ggx --what dfg,prefilter --size 8 -o one");
    run_line(0, "\"name\": \"dfg\"", "vndf bake ggx --what dfg,prefilter --size 8 --json -o two");
    run_line(0, "", "diff -r one two");
    TEST(run_count("one", "") == 13);
    /* Three numbers of four bytes for 64 texels, four of two. */
    test_form("one/dfg.npy", 128 + 64 * 3 * 4, "\x93NUMPY\1");
    test_form("one/dfg.dds", 148 + 64 * 4 * 2, "DDS \x7c\0\0");
    run_line(0, "", "grep -qF 'static const float dfg[192] = {' one/dfg.h");
    run_line(0, "", "grep -q '// made by: vndf bake ggx --what dfg,prefilter --size 8' one/dfg.h");
    run_line(0, "",
             "grep -qF 'const float dfg[192] = float[192](' one/dfg.glsl && grep -q dfg.png one/index.html");
    run_line(0, "", "vndf bake ggx --what ltc --size 4 --format js -o one -q >said && [ ! -s said ]");
    run_line(0, "\nverdict good to ship\n",
             "vndf bake " VNDF_SOURCE_DIR "/tables/hazy.vndf --what ltc --size 8 --format npy -o haze");
    TEST(run_count("haze", "") == 5);
    /* No transformed cosine resembles a ring of light: the last line, and on stderr. */
    run_line(
        0, "vndf bake: doubtful: ltc_inverse is 0.3",
        "vndf build --slope 'exp(-3*r)*(1+0.8*cos(6*r))' -q -o rings.vndf 2>/dev/null;"
        "vndf bake rings.vndf --what ltc --size 8 --format npy -o rings >said; s=$?;"
        "tail -n 1 said | grep -q '^verdict doubtful: ltc_inverse is 0.3[0-9]* off in the mean, ' && exit $s");
    /* The example in GLSL compiles, where there is a compiler. */
    run_line(0, "",
             "! command -v glslangValidator >said || glslangValidator " VNDF_SOURCE_DIR
             "/tools/bake/examples/haze.frag");
    run_line(0, "", "rm -r *");
    return run_end(folder);
}
