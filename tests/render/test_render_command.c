/* The command renders to PNG and PFM, prints figures for people and as JSON, refuses what is wrong with status 2 before
 * it writes anything: words, and lines of a scene. A picture is the same to the bit for any number of threads; another
 * seed gives another; a map of 1/2 halves roughness. Notices options that are not read, sums in the order of arrival, a
 * picture that is half written, text mixed into JSON, and a comparison that alarms about one sample a pixel. */
#include "harness/run_program.h"

static void test_refusals(void)
{
    static const struct {
        const char *words, *says;
    } bad[] = {
        {"ball.scene", "-o OUT.png or -o OUT.pfm is missing"},
        {"-o x.png", "SCENE is missing"},
        {"ball.scene -o x.jpg", "the name must end in .png or .pfm"},
        {"ball.scene --compare visible", "--compare takes two samplers at least"},
        {"ball.scene --compare all,visible --sampler all", "leave one out"},
        {"ball.scene -o - --json", "figures go to stdout, where -o - puts the picture"},
        {"ball.scene -o x.png --width 16384", "--width: 16384 x 16384 pixels"},
        {"walk.scene --compare visible,all", "material 'm' cannot have the sampler 'all'"},
        {"no.scene -o x.png", "no.scene: No such file"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        run_line(2, bad[i].says, "vndf render %s", bad[i].words);
    TEST(run_count(".", "x.") == 0 && run_count(".", ".tmp") == 0);
}

#define SEEN "camera --from 0,0,5 --to 0,0,0\n"
#define MATTE "material m --matte 1,1,1\n"
#define OF(distribution) "material m --shape --distribution " distribution "\n"

/* Scenes, the line that is wrong (0: the whole), and what is said. */
static void test_scenes(void)
{
    static const struct {
        const char *text;
        int line;
        const char *says;
    } bad[] = {
        {"", 0, "the scene ends without a camera"},
        {SEEN, 1, "the scene ends without light"},
        {SEEN "spere\033 --centre 0,0,0\n", 2, "'spere?' is no statement"},
        {SEEN SEEN, 2, "'camera' stands in this scene twice"},
        {SEEN "sphere 1 --centre 0,0,0\n", 2, "'1' is not expected"},
        {"camera --from 0,0,5\n", 1, "--to X,Y,Z is missing"},
        {"camera --from 0,0,1e7 --to 0,0,0\n", 1, "--from '0,0,1e7' is not in the range"},
        {"camera --from 0,0,5 --to 0,0,5\n", 1, "--from and --to are the same place"},
        {"camera --from 0,5,0 --to 0,0,0\n", 1, "--up is the direction of the view"},
        {"camera --from 0,0,5 --fild 3\n", 1, "there is no option '--fild'; did you mean '--field'?"},
        {"camera \"--from\n", 1, "'\"--from' is not expected"},
        {"camera --from 0,0,5 --to 0,0,0 --width 16384 --height 16384\n", 1, "16384 x 16384 pixels are more than"},
        {"environment --constant 1,1,1 --turn 3\n", 1, "--turn is for --image"},
        {"environment\n", 1, "exactly one is needed of --constant or --image"},
        {"environment --image none.pfm\n", 1, "none.pfm: No such file"},
        {"environment --image tiles:9\n", 1, "--image '9' has too few numbers"},
        {"material --matte 1,1,1\n", 1, "'material' needs one name"},
        {MATTE MATTE, 2, "there is another material 'm' already"},
        {"material m --matte 1,1,1 --colour-map studio\n", 1, "must be from 0 to 1; it is "},
        {"material m --conductor gold\n", 1, "--conductor needs --distribution D"},
        {"material m --light 1,1,1 --distribution ggx\n", 1, "--light has no --distribution D"},
        {"material m --matte 1,1,1 --alpha 1\n", 1, "--alpha is for --distribution"},
        {"material m --eta 0,0,0 --distribution ggx --alpha 1\n", 1, "conductor"},
        {OF("ggx"), 1, "ggx needs --alpha A or --alpha AX,AY"},
        {OF("\"slope=exp(-\""), 1, ""},
        {OF("none.vndf"), 1, "none.vndf"},
        {"sphere --centre 0,0,0 --radius 1 --material m\n", 1, "--material 'm' is no material that is defined"},
        {MATTE "sphere --centre 0,0,0 --material m\n", 2, "--radius R is missing"},
        {MATTE "rectangle --corner 0,0,0 --edge-u 1,0,0 --edge-v 1,1,0 --material m\n", 2, "are at 45 degrees"},
        {MATTE "rectangle --corner 0,0,0 --edge-u 0,0,0 --edge-v 1,1,0 --material m\n", 2,
         "an edge has no length"},
        {"material m --light 1,1,1\nmesh --file a --material m\n", 2, "a light is a sphere or a rectangle"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char place[64];
        snprintf(place, sizeof place, "vndf render: bad.scene%s%.0d: ", bad[i].line ? ":" : "", bad[i].line);
        TEST(run_put("bad.scene", bad[i].text));
        TEST_HAS(run_line(2, bad[i].says, "vndf render bad.scene -o x.png")->text, place);
    }
    TEST(run_count(".", "x.") == 0);
}

int main(void)
{
    char folder[] = "render.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    TEST(run_put("ball.scene", run_scene));
    TEST(run_put("walk.scene",
                 "camera --from 0,0,5 --to 0,0,0 --width 8 --height 8\nenvironment --constant 1,1,1\n"
                 "material m --shape --distribution ggx --alpha 1 --scattering multiple\n"));
    run_line(0, "8 x 8 pixels, 64 samples each", "vndf render ball.scene -o a.pfm --spp 64 --threads 1");
    run_line(0, "", "vndf render ball.scene -o b.pfm --spp 64 --threads 3");
    run_line(0, "", "vndf render ball.scene -o c.pfm --spp 64 --threads 16");
    run_line(0, "", "vndf render ball.scene -o e.pfm --spp 64 --seed 1");
    run_line(0, "", "cmp a.pfm b.pfm && cmp a.pfm c.pfm && ! cmp -s a.pfm e.pfm");
    TEST(run_put("half.scene",
                 "camera --from 0,0,5 --to 0,0,0 --width 1 --height 1\nenvironment --constant 0.5,0.5,0.5\n"));
    run_line(0, "",
             "vndf render half.scene -o half.pfm --spp 1 &&"
             "sed 's/alpha 0.2/alpha 0.4 --alpha-map half.pfm/' ball.scene >map.scene &&"
             "vndf render map.scene -o d.pfm --spp 64 && cmp a.pfm d.pfm");
    test_refusals();
    test_scenes();
    run_line(0, " perfect ", "vndf render ball.scene --compare visible,all,perfect --spp 32 -o s.png");
    const run_outcome *o =
        run_line(0, "", "vndf render ball.scene --compare visible,all --spp 1 --equal samples --json");
    static const char *const has[] = {"\"interrupted\": \"no\"", "\"samples\": 1,", "\"noise\": null",
                                      "\"verdict\": \"unknown\"", "\"deviations\": null"};
    TEST(o->text[0] == '[' && strcmp(o->text + strlen(o->text) - 4, "}\n]\n") == 0);
    for (size_t i = 0; i < sizeof has / sizeof *has; i++)
        TEST_HAS(o->text, has[i]);
    run_line(0, " unknown", "vndf render ball.scene --compare visible,all --spp 1 --equal samples");
    run_line(0, "--distribution D ", "vndf render --grammar");
    TEST(system("rm *.scene *.pfm *.png") == 0);
    return run_end(folder);
}
