/* The command renders to PNG and PFM, prints figures for people and as JSON, refuses what is wrong with status 2
 * before it writes anything: words, lines of a scene, images and meshes, with the file and the place. A picture is
 * the same to the bit for any number of threads; another seed gives another; a map of 1/2 halves roughness. Images
 * of either byte order, of one channel, with CR LF are read. Images lie upright on rectangles, around spheres with
 * the top at +y; meshes are scaled, turned and moved. Notices options that are not read, sums in the order of
 * arrival, a picture that is half written, text mixed into JSON, a comparison that alarms about one sample a pixel;
 * rows from the wrong end, a byte order that is not swapped, sizes that are believed; indices off by one or taken
 * from the wrong end, polygons cut wrongly, u and v exchanged or flipped, normals that do not win over the order of
 * corners. */
#include "harness/run_program.h"

#include "cli/files.h"

#define BYTES(literal) literal, sizeof literal - 1

static void put(const char *name, const char *bytes, size_t size)
{
    FILE *file = fopen(name, "wb");
    TEST(file && fwrite(bytes, 1, size, file) == size);
    TEST(file && fclose(file) == 0);
}

/* ---- refusals ---- */

#define SEEN "camera --from 0,0,5 --to 0,0,0\n"
#define MATTE "material m --matte 1,1,1\n"
#define OF(distribution) "material m --shape --distribution " distribution "\n"
#define PIXEL "\0\0\x80\x3f"
#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

/* What is said begins with the file that is wrong. */
static void test_refusals(void)
{
    static const struct {
        const char *words, *says;
    } asked[] = {
        {"ball.scene", "-o OUT.png or -o OUT.pfm is missing"},
        {"-o x.png", "SCENE is missing"},
        {"ball.scene -o x.jpg", "the name must end in .png or .pfm"},
        {"ball.scene --compare visible", "--compare takes two samplers at least"},
        {"ball.scene --compare all,visible --sampler all", "leave one out"},
        {"ball.scene -o - --json", "figures go to stdout, where -o - puts the picture"},
        {"ball.scene -o x.png --width 16384", "16384 x 16384 pixels"},
        {"walk.scene --compare visible,all", "material 'm' cannot have the sampler 'all'"},
        {"no.scene -o x.png", "no.scene: No such file"},
    };
    static const struct {
        const char *bytes;
        size_t size;
        const char *says;
    } bad[] = {
        {BYTES(""), "scene: the scene ends without a camera"},
        {BYTES(SEEN), "scene:1: the scene ends without light"},
        {BYTES(SEEN "spere\033 --centre 0,0,0\n"), "scene:2: 'spere?' is no statement"},
        {BYTES(SEEN SEEN), "scene:2: 'camera' stands in this scene twice"},
        {BYTES(SEEN "sphere 1 --centre 0,0,0\n"), "scene:2: '1' is not expected"},
        {BYTES("camera --from 0,0,5\n"), "scene:1: --to X,Y,Z is missing"},
        {BYTES("camera --from 0,0,1e7 --to 0,0,0\n"), "scene:1: --from '0,0,1e7' is not in the range"},
        {BYTES("camera --from 0,0,5 --to 0,0,0 --width 1.5\n"), "scene:1: --width '1.5' is not a whole number"},
        {BYTES("camera --from 0,0,5 --to 0,0,5\n"), "scene:1: --from and --to are the same place"},
        {BYTES("camera --from 0,5,0 --to 0,0,0\n"), "scene:1: --up is the direction of the view"},
        {BYTES("camera --from 0,0,5 --fild 3\n"), "scene:1: there is no option '--fild'; did you mean '--field'?"},
        {BYTES("environment --constant 1,1,1 --turn 3\n"), "scene:1: --turn is for --image"},
        {BYTES("environment\n"), "scene:1: exactly one is needed of --constant or --image"},
        {BYTES("environment --image tiles:9\n"), "scene:1: --image '9' has too few numbers"},
        {BYTES("material --matte 1,1,1\n"), "scene:1: 'material' needs one name"},
        {BYTES(MATTE MATTE), "scene:2: there is another material 'm' already"},
        {BYTES("material m --matte 1,1,1 --colour-map studio\n"), "the image must be from 0 to 1; it is "},
        {BYTES("material m --conductor gold\n"), "scene:1: --conductor needs --distribution D"},
        {BYTES("material m --light 1,1,1 --distribution ggx\n"), "scene:1: --light has no --distribution D"},
        {BYTES("material m --eta 0,0,0 --distribution ggx --alpha 1\n"), "conductor"},
        {BYTES(OF("slope=exp(-")), "scene:1: "},
        {BYTES(OF("none.vndf")), "none.vndf"},
        {BYTES("sphere --centre 0,0,0 --radius 1 --material m\n"), "scene:1: --material 'm' is no material"},
        {BYTES(MATTE "rectangle --corner 0,0,0 --edge-u 1,0,0 --edge-v -2,0,0 --material m\n"), "have no area"},
        {BYTES("material m --light 1,1,1\nmesh --file a --material m\n"), "for spheres and rectangles"},
        {BYTES("P4\n1 1\n255\n"), "image: this is no PFM, PGM or PPM image"},
        {BYTES("PF\n1 1\n"), "image: the head is not whole: after PF come width, height, a scale"},
        {BYTES("P6\n1 1\n65536\n123"), "image: 65536 must be the largest value, from 1 to 65535"},
        {BYTES("P5\n1 2\n256\n\0\0\1"), "image: 1 x 2 pixels take 4 bytes after the head, and there are 3"},
        {BYTES("P5\n1 1\n255\n1"), "image holds whole numbers; a PFM is needed"},
        {BYTES("Pf\n0 1\n-1\n" PIXEL), "image: 0 x 1 pixels: sides are from 1 to 16384"},
        {BYTES("Pf\n16384 16384\n-1\n" PIXEL), "image: 16384 x 16384 pixels: "},
        {BYTES("Pf\n1 1\n0\n" PIXEL), "image: 0 must be a number other than 0"},
        {BYTES("Pf\n2 1\n-1\n" PIXEL "\0\0\x80\x7f"), "image: the pixel in column 1 of row 0 (from the top"},
        {BYTES(""), "mesh: the file ends here without a triangle that has an area"},
        {BYTES("v 0\0 0"), "mesh: the file has a byte 0"},
        {BYTES("v 0 0 0\nv 1 0\n"), "mesh:2: there are 2 numbers of 3 in this line"},
        {BYTES("v 0 0 nan\n"), "mesh:1: v 'nan' is not a number"},
        {BYTES("v 0 0 1e9\n"), "mesh:1: v '1e9' is not in the range from -10000000 to 10000000"},
        {BYTES(TRIANGLE "f 1 2\n"), "mesh:4: a face has 3 corners or more, this one has 2"},
        {BYTES(TRIANGLE "f 1 2 4\n"), "mesh:4: 4 is none of the 3 lines 'v' before this"},
        {BYTES(TRIANGLE "f 0 1 2\n"), "mesh:4: 0 is none of the 3 lines 'v' before this"},
        {BYTES(TRIANGLE "f 1//1 2 3\n"), "mesh:4: 1 is none of the 0 lines 'vn'"},
        {BYTES(TRIANGLE "f 1a 2 3\n"), "mesh:4: '1a' should be v, v/vt, v//vn or v/vt/vn"},
        {BYTES("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "mesh:4: the file ends here without a triangle"},
    };
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++)
        run_line(2, asked[i].says, "vndf render %s", asked[i].words);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const char *says = bad[i].says;
        put("image", BYTES("Pf\n1 1\n-1\n" PIXEL));
        put("scene", BYTES(SEEN "environment --image image\n" MATTE "mesh --file mesh --material m\n"));
        put(*says == 'i' ? "image" : strncmp(says, "mesh", 4) == 0 ? "mesh" : "scene", bad[i].bytes, bad[i].size);
        run_line(2, says, "vndf render scene -o x.png");
    }
}

/* ---- pictures ---- */

/* Light of 2 from above, where there is the top row of an image alone. */
static void test_forms(void)
{
    static const struct {
        const char *bytes;
        size_t size;
    } forms[] = {
        {BYTES("PF\n1 1\n2.5\n\x40\0\0\0\x40\0\0\0\x40\0\0\0")},
        {BYTES("Pf\r\n# grey\n1 2\r\n-1\r\n\0\0\0\0\0\0\0\x40")},
    };
    TEST(run_put("a.scene", "camera --from 0,0,0 --to 0,9,0 --up 0,0,1 --field 1\nenvironment --image image\n"));
    TEST(run_put("b.scene", SEEN "environment --constant 2,2,2\n"));
    run_line(0, "", "vndf render b.scene --width 8 --spp 1 -o b.pfm");
    for (size_t i = 0; i < 2; i++) {
        put("image", forms[i].bytes, forms[i].size);
        run_line(0, "", "vndf render a.scene --width 8 --spp 1 -o a.pfm && cmp a.pfm b.pfm");
    }
}

#define GREY "environment --constant 1,1,1\nmaterial m --matte 0.5,0.5,0.5\n"

/* Before a white sky a grey mesh is the rectangle that it makes. */
static void test_meshes(void)
{
    static const char corners[] = "v 0 0 0\nv 1 0 0\nv 1 1 0 0.5 x\nv 0 1 0\nvt 0 0\nvn 0 0 9\n";
    static const char *const faces[] = {"f 1/1 2/1 3/1 4/1\n", "# a comment\no name\nf -4/-4 -3 -2 -1 # more\r\n",
                                        "f 4//1 3//1 2//1 1//1"}; /* the other way round; normals win */
    TEST(run_put("a.scene", "camera --from 5,0,0 --to 0,0,0\n" GREY
                            "rectangle --corner 0,-1,0.5 --edge-u 0,0,-2 --edge-v 0,2,0 --material m\n"));
    TEST(run_put("b.scene", "camera --from 5,0,0 --to 0,0,0\n" GREY
                            "\tmesh --file mesh --scale 2 --turn 90 --move 0,-1,0.5 --material m#\r\n"));
    run_line(0, "", "vndf render a.scene --width 64 --spp 4 -o a.pfm");
    for (int i = 0; i < 3; i++) {
        run_line(0, "", "printf '%s%s' >mesh", corners, faces[i]);
        run_line(0, "", "vndf render b.scene --width 64 --spp 4 -o b.pfm && cmp a.pfm b.pfm");
    }
}

/* An image of red (R) and green above blue and black (K): the colours that are seen in the corners. */
static void test_upright(const char *camera, const char *shape, const char *want)
{
    char text[1024], seen[5] = "";
    size_t size;
    snprintf(text, sizeof text,
             "camera --from %s --to 0,0,0 --width 4 --height 4 --depth 1\nenvironment --constant 1,1,1\n"
             "material m --matte 1,1,1 --colour-map \"four.pfm\"\n%s --material m\n",
             camera, shape);
    TEST(run_put("up.scene", text));
    run_line(0, "", "vndf render up.scene -o up.pfm --spp 64");
    char *bytes = run_file("up.pfm", &size);
    for (int i = 0; i < 4 && TEST(bytes && size >= 192); i++) { /* rows from the bottom */
        const unsigned char *at = (unsigned char *)bytes + size - 192 + 12 * ((i < 2 ? 12 : 0) + i % 2 * 3);
        seen[i] = 'K';
        for (int k = 0; k < 3; k++)
            seen[i] = little_number(at + 4 * k, 4) > 0.4 ? "RGB"[k] : seen[i];
    }
    if (!TEST(strcmp(seen, want) == 0))
        fprintf(stderr, "    %s: %s, not %s\n", shape, seen, want);
    free(bytes);
}

static void test_places(void)
{
    put("four.pfm", BYTES("PF\n2 2\n-1\n\0\0\0\0\0\0\0\0" PIXEL "\0\0\0\0\0\0\0\0\0\0\0\0" PIXEL
                          "\0\0\0\0\0\0\0\0\0\0\0\0" PIXEL "\0\0\0\0"));
    test_upright("0,0,5 --field 22", "rectangle --corner -1,-1,0 --edge-u 2,0,0 --edge-v 0,2,0", "RGBK");
    /* around the sphere u goes from +z by way of +x: seen from -x its first half is behind, the seam at -z left */
    test_upright("5,0,0 --field 18", "sphere --centre 0,0,0 --radius 1", "RRBB");
    test_upright("-5,0,0 --field 18", "sphere --centre 0,0,0 --radius 1", "GGKK");
}

static void test_compare(void)
{
    static const char *const has[] = {"\"interrupted\": \"no\"", "\"samples\": 1,", "\"noise\": null",
                                      "\"verdict\": \"unknown\"", "\"deviations\": null"};
    run_line(0, " perfect ", "vndf render ball.scene --compare visible,all,perfect --spp 32 -o s.png");
    run_line(0, " unknown", "vndf render ball.scene --compare visible,all --spp 1 --equal samples");
    const run_outcome *o =
        run_line(0, "", "vndf render ball.scene --compare visible,all --spp 1 --equal samples --json");
    TEST(o->text[0] == '[' && strcmp(o->text + strlen(o->text) - 4, "}\n]\n") == 0);
    for (size_t i = 0; i < sizeof has / sizeof *has; i++)
        TEST_HAS(o->text, has[i]);
}

int main(void)
{
    char folder[] = "render.XXXXXX";
    if (!run_begin(folder))
        return test_done();
    TEST(run_put("ball.scene", run_scene));
    TEST(run_put("walk.scene", SEEN "environment --constant 1,1,1\n" OF("ggx --alpha 1 --scattering multiple")));
    test_refusals();
    TEST(run_count(".", "x.") == 0 && run_count(".", ".tmp") == 0);
    run_line(0, "8 x 8 pixels, 64 samples each", "vndf render ball.scene -o a.pfm --spp 64 --threads 1");
    run_line(0, "", "vndf render ball.scene -o b.pfm --spp 64 --threads 16 && cmp a.pfm b.pfm");
    run_line(0, "", "vndf render ball.scene -o e.pfm --spp 64 --seed 1 && ! cmp -s a.pfm e.pfm");
    put("half.pfm", BYTES("Pf\n1 1\n-1\n\0\0\0\x3f"));
    run_line(0, "",
             "sed 's/alpha 0.2/alpha 0.4 --alpha-map half.pfm/' ball.scene >map.scene &&"
             "vndf render map.scene -o d.pfm --spp 64 && cmp a.pfm d.pfm");
    test_forms();
    test_meshes();
    test_places();
    test_compare();
    run_line(0, "--distribution D ", "vndf render --grammar");
    TEST(system("rm *.scene *.pfm *.png image mesh scene") == 0);
    return run_end(folder);
}
