/* The command renders to PNG and PFM, prints figures for people and as JSON, refuses what is wrong with status 2
 * before it writes anything. A picture is the same to the bit for any
 * number of threads; another seed gives another. Notices options that are not read, sums in the order of
 * arrival, a picture that is half written, text mixed into JSON, and a comparison that alarms about one sample a
 * pixel. */
#include "harness/run_program.h"

static void test_refusals(void)
{
    static const struct {
        const char *words, *says;
    } bad[] = {
        {"ball.scene", "-o OUT.png or -o OUT.pfm is missing"},
        {"-o x.png", "SCENE is missing"},
        {"ball.scene -o x.jpg", "the name must end in .png or .pfm"},
        {"ball.scene -o x.png --sampler visibel", "did you mean 'visible'?"},
        {"ball.scene --compare visible", "--compare takes two samplers at least"},
        {"ball.scene --compare all,all", "--compare 'all,all' has 'all' twice"},
        {"ball.scene --compare all,visible --sampler all", "leave one out"},
        {"ball.scene -o x.png --equal time", "--equal is for --compare"},
        {"ball.scene -o - --json", "figures go to stdout, where -o - puts the picture"},
        {"ball.scene -o x.png --spp 0", "--spp"},
        {"ball.scene -o x.png --width 16384", "--width: 16384 x 16384 pixels"},
        {"bad.scene -o x.png", "vndf render: bad.scene:2: 'speed' is no word that begins a line"},
        {"walk.scene --compare visible,all", "material 'm' cannot have the sampler 'all'"},
        {"no.scene -o x.png", "no.scene: No such file"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        run_line(2, bad[i].says, "vndf render %s", bad[i].words);
    TEST(run_count(".", "x.") == 0 && run_count(".", ".tmp") == 0);
}

int main(void)
{
    char folder[] = "render.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    TEST(run_put("ball.scene", run_scene) && run_put("bad.scene", "film width 8 height 8\nspeed 3\n"));
    TEST(run_put("walk.scene", "film width 8 height 8\ncamera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
                               "material m shape distribution ggx alpha 1 scattering multiple\n"));
    run_line(0, "8 x 8 pixels, 64 samples each", "vndf render ball.scene -o a.pfm --spp 64 --threads 1");
    run_line(0, "", "vndf render ball.scene -o b.pfm --spp 64 --threads 3");
    run_line(0, "", "vndf render ball.scene -o c.pfm --spp 64 --threads 16");
    run_line(0, "", "vndf render ball.scene -o e.pfm --spp 64 --seed 1");
    run_line(0, "", "cmp a.pfm b.pfm && cmp a.pfm c.pfm && ! cmp -s a.pfm e.pfm");
    test_refusals();
    run_line(0, " perfect ", "vndf render ball.scene --compare visible,all,perfect --spp 32 -o s.png");
    const run_outcome *o =
        run_line(0, "", "vndf render ball.scene --compare visible,all --spp 1 --equal samples --json");
    static const char *const has[] = {"\"interrupted\": \"no\"", "\"samples\": 1,", "\"noise\": null",
                                      "\"verdict\": \"unknown\"", "\"deviations\": null"};
    TEST(o->text[0] == '[' && strcmp(o->text + strlen(o->text) - 4, "}\n]\n") == 0);
    for (size_t i = 0; i < sizeof has / sizeof *has; i++)
        TEST_HAS(o->text, has[i]);
    run_line(0, "no variance", "vndf render ball.scene --compare visible,all --spp 1 --equal samples");
    run_line(0, "width PIXELS               1 to 16384", "vndf render --grammar");
    TEST(system("rm *.scene *.pfm *.png") == 0);
    return run_end(folder);
}
