/* Files are what they say, and broken ones are refused with the place and the reason. A PFM that is written is
 * read back to the bit; files of either byte order, of one channel, with CR LF are read. Meshes are scaled,
 * turned and moved; a broken one adds nothing. Scenes that are wrong are refused with file, line, column and
 * what would be right. Notices rows from the wrong end, a byte order that is not swapped, sizes that are
 * believed; indices off by one or taken from the wrong end, polygons cut wrongly, v not flipped, normals that do
 * not win over the order of corners; clauses that are taken where they do not belong, numbers that are not
 * checked, words that are cut wrongly, and places that are off. */
#include "render_case.h"

#define BYTES(literal) literal, sizeof literal - 1

/* ---- images ---- */

static void test_round_trip(void)
{
    static const float values[6][3] = {{0, -1, 1e-30f}, {1e30f, 0.1f, 3}, {4, 5, 6},
                                       {7, 8, 9},       {10, 11, 12},     {13, 14, 15}};
    image made, back;
    vndf_error error;
    unsigned char bytes[256];
    FILE *file = tmpfile();
    if (!TEST(file && image_make(&made, 3, 2)))
        return;
    memcpy(made.rgb, values, sizeof values);
    TEST(image_write_pfm(file, &made));
    rewind(file);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    TEST(size == strlen("PF\n3 2\n-1.0\n") + sizeof values && memcmp(bytes, "PF\n3 2\n-1.0\n", 12) == 0);
    if (TEST(image_read_bytes(&back, "x", bytes, size, &error)))
        TEST(back.width == 3 && back.height == 2 && memcmp(back.rgb, values, sizeof values) == 0);
    image_free(&back);
    image_free(&made);
    fclose(file);
}

/* Either byte order, one channel, whole numbers of 16 bits, CR LF: the first two pixels. */
static void test_forms(void)
{
    static const struct {
        const char *bytes;
        size_t size;
        float rgb[6];
    } forms[] = {
        {BYTES("PF\n1 1\n2.5\n\x3f\x80\0\0\x40\0\0\0\xc0\0\0\0"), {1, 2, -2}},
        {BYTES("Pf\r\n1 2\r\n-1\r\n\0\0\x80\x3f\0\0\0\x40"), {2, 2, 2, 1, 1, 1}},
        {BYTES("P6\n# two\n2 1\n1024\n\0\0\2\0\4\0\1\0\0\0\0\0"), {0, 0.5f, 1, 0.25f}},
    };
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        image made;
        vndf_error error;
        if (TEST(image_read_bytes(&made, "x", forms[i].bytes, forms[i].size, &error)))
            TEST(memcmp(made.rgb, forms[i].rgb, (i ? 6 : 3) * sizeof(float)) == 0);
        image_free(&made);
    }
}

/* ---- meshes ---- */

#define CORNERS "v 0 0 0\nv 1 0 0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 9\n"

static void test_square(const char *text)
{
    geometry g = {0};
    vndf_error error;
    if (!TEST(obj_read_text(&g, "x.obj", text, strlen(text), 7, &error) && g.count == 2 && geometry_build(&g)))
        return;
    for (int i = 0; i < 4; i++) {
        const double x = i % 2 ? 0.75 : 0.25, y = i / 2 ? 0.75 : 0.25;
        const ray r = {{x, y, 3}, {0, 0, -1}, HUGE_VAL};
        hit h;
        TEST(geometry_hit(&g, &r, &h) && h.normal.z > 0.999 && fabs(h.distance - 3) < 1e-12 &&
             h.shape->material == 7);
        TEST_NEAR(h.u, x, 1e-6);
        TEST_NEAR(h.v, 1 - y, 1e-6);
    }
    geometry_free(&g);
}

/* A quarter turn takes z to x; what was there before stays. */
static void test_placement(void)
{
    static const char text[] = "v 0 0 1\nv 0 0 2\nv 0 1 1\nvn 0 0 3\nf 1//1 2//1 3//1\n";
    geometry g = {0};
    vndf_error error;
    for (int i = 0; i < 2; i++)
        TEST(obj_read_text(&g, "x.obj", text, strlen(text), 0, &error));
    geometry_place(&g, 1, 2, PI / 2, vec(10, 20, 30));
    const shape *t = &g.shapes[1];
    TEST(g.count == 2 && g.shapes[0].corner.z == 1);
    TEST_NEAR(length(subtract(t->corner, vec(12, 20, 30))), 0, 1e-12);
    TEST_NEAR(length(subtract(t->edge_u, vec(2, 0, 0))), 0, 1e-12);
    TEST_NEAR((double)t->normal[0].x, 1, 1e-6);
    geometry_free(&g);
}

/* ---- refusals ---- */

enum { IMAGE, MESH, SCENE };

/* Nothing comes of the bytes, and the reason is said with the name and the place. */
static void refused(int kind, const char *bytes, size_t size, const char *says)
{
    static const char *const starts[] = {"x: ", "x.obj:", "x.scene:"};
    image map = {.rgb = NULL};
    geometry g = {0};
    vndf_error error = {VNDF_OK, ""};
    scene *s = kind == SCENE ? case_read(bytes, &error) : NULL;
    int good = kind == IMAGE  ? image_read_bytes(&map, "x", bytes, size, &error)
               : kind == MESH ? obj_read_text(&g, "x.obj", bytes, size, 7, &error)
                              : s != NULL;
    if (!(TEST(!good && !map.rgb && !g.count) & TEST_HAS(error.message, says) &
          TEST(strncmp(error.message, starts[kind], strlen(starts[kind])) == 0)))
        fprintf(stderr, "    %s    says %s\n", bytes, error.message);
    geometry_free(&g);
    scene_free(s);
}

#define PIXEL "\0\0\x80\x3f"
#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define LIT "camera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
#define GOLD "material m conductor of gold distribution ggx alpha 0.2\n"

static const struct {
    int kind;
    const char *bytes;
    size_t size;
    const char *says;
} bad[] = {
    {IMAGE, BYTES(""), "this is no PFM, PGM or PPM image"},
    {IMAGE, BYTES("P4\n1 1\n255\n"), "this is no PFM, PGM or PPM image"},
    {IMAGE, BYTES("PF\n1 1\n"),
     "the head of the image is not whole: after PF come width, height, a scale and a blank"},
    {IMAGE, BYTES("P6\n1 1\n65536\n123"), "the largest value is '65536'; it must be from 1 to 65535"},
    {IMAGE, BYTES("P5\n1 2\n256\n\0\0\1"), "1 x 2 pixels take 4 bytes after the head, and there are 3"},
    {IMAGE, BYTES("Pf\n0 1\n-1\n" PIXEL), "0 x 1 pixels: sides are whole numbers from 1 to 16384"},
    {IMAGE, BYTES("Pf\n16384 16384\n-1\n" PIXEL), "and there are 33554432 pixels at most"},
    {IMAGE, BYTES("Pf\n1 1\n0\n" PIXEL), "'0' must be a number other than 0"},
    {IMAGE, BYTES("Pf\n1 1\n-1\n" PIXEL "\0"), "1 x 1 pixels take 4 bytes after the head, and there are 5"},
    {IMAGE, BYTES("Pf\n2 1\n-1\n" PIXEL "\0\0\x80\x7f"),
     "the pixel in column 1 of row 0 (from the top, from 0) is not finite"},
    {MESH, BYTES(""), ":1: the file ends here without a triangle that has an area"},
    {MESH, BYTES("v 0\0 0"), ":1: the file has a byte 0"},
    {MESH, BYTES("v 0 0 0\nv 1 0\n"), ":2: there are 2 numbers of 3 in this line"},
    {MESH, BYTES("v 0 0 nan\n"), ":1: 'nan' should be a number"},
    {MESH, BYTES("v 0 0 1e9\n"), ":1: numbers of 'v' lie within 1e+07 of 0, and these do not"},
    {MESH, BYTES("v 0 0 1e999\n"), ":1: numbers of 'v' lie within 1e+07 of 0"},
    {MESH, BYTES(TRIANGLE "f 1 2\n"), ":4: a face has 3 corners or more, this one has 2"},
    {MESH, BYTES(TRIANGLE "f 1 2 4\n"), ":4: 4 is none of the 3 lines 'v' before this"},
    {MESH, BYTES(TRIANGLE "f 0 1 2\n"), ":4: 0 is none of the 3 lines 'v' before this, which are counted from 1"},
    {MESH, BYTES(TRIANGLE "f 1/1 2 3\n"), ":4: 1 is none of the 0 lines 'vt'"},
    {MESH, BYTES(TRIANGLE "f 1/ 2 3\n"), ":4: '1/' should be v, v/vt, v//vn or v/vt/vn, in numbers"},
    {MESH, BYTES(TRIANGLE "f 1a 2 3\n"), ":4: '1a' should be v, v/vt, v//vn or v/vt/vn, and end there"},
    {MESH, BYTES("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), ":4: the file ends here without a triangle"},
    {SCENE, BYTES(""), ":1:1: the scene ends without a camera"},
    {SCENE, BYTES("camera from 0 0 5 to 0 0 0\n"), ":1:26: the scene ends without light"},
    {SCENE, BYTES(LIT "light from 1\n"), ":3:1: 'light' is no statement; it must be one of: film, camera"},
    {SCENE, BYTES(LIT "spere centre 0 0 0\n"), ":3:1: 'spere' is no statement; did you mean 'sphere'?"},
    {SCENE, BYTES(" camera from 0 0 5 to 0 0 0\n"), ":1:2: a statement begins in the first column"},
    {SCENE, BYTES(LIT "camera from 0 0 5 to 0 0 0\n"), ":3:1: 'camera' stands in this scene twice"},
    {SCENE, BYTES("camera from 0 0 5\n"), ":1:1: 'camera' needs 'to X Y Z'"},
    {SCENE, BYTES("camera from 0 0 5 to 0 0 from 1 2 3\n"), ":1:26: 'from' is no number; it must be 'to X Y Z'"},
    {SCENE, BYTES("camera from 0 0 5 to 0 0 0 from 1 2 3\n"), ":1:28: 'from' stands in this statement twice"},
    {SCENE, BYTES("camera from 0 0 5 to 0 0\n"), ":1:19: the statement ends before all of 'to X Y Z' was there"},
    {SCENE, BYTES("camera from 0 0 nan to 0 0 0\n"), ":1:17: 'nan' is no number"},
    {SCENE, BYTES("camera from 0 0 1e7 to 0 0 0\n"),
     ":1:17: from is 10000000, it must be from -1000000 to 1000000"},
    {SCENE, BYTES("camera from 0 0 5 to 0 0 5\n"), ":1:19: 'from' and 'to' are the same place"},
    {SCENE, BYTES("camera from 0 5 0 to 0 0 0\n"), ":1:1: 'up' is the direction of the view"},
    {SCENE, BYTES("camera from 0 0 5 to 0 0 0 fild 3\n"),
     ":1:28: 'fild' is no clause here; did you mean 'field'?"},
    {SCENE, BYTES("film width 1.5 height 3\n"), ":1:12: width is 1.5, it must be a whole number"},
    {SCENE, BYTES("film width 16384 height 16384\n"), ":1:1: 16384 x 16384 pixels are more than"},
    {SCENE, BYTES("environment scale 2\n"), ":1:1: 'environment' needs one of 'constant R G B' and 'image NAME'"},
    {SCENE, BYTES("environment constant 1 1 1 turn 3\n"), ":1:28: 'turn' stands beside 'image' only"},
    {SCENE, BYTES("image a pattern tils\n"), ":1:17: tils: there is no such pattern, but tiles, grid and studio"},
    {SCENE, BYTES("image a file none.pfm\n"), "none.pfm: No such file"},
    {SCENE, BYTES("image a pattern tiles\nimage a pattern grid\n"), ":2:7: there is another image 'a' already"},
    {SCENE, BYTES("image a\n"), ":1:1: 'image' needs a name and what it is"},
    {SCENE, BYTES(GOLD GOLD), ":2:10: there is another material 'm' already"},
    {SCENE, BYTES("material m matte\n"), ":1:12: 'matte' needs 'colour R G B'"},
    {SCENE, BYTES("material m matte colour 1 1 1 alpha 2\n"),
     ":1:31: 'alpha' is no clause here; it must be one of: colour, colour-map"},
    {SCENE, BYTES("material m conductor distribution ggx alpha 1\n"),
     ":1:12: 'conductor' needs one of 'of METAL' and 'eta R G B'"},
    {SCENE, BYTES("material m conductor of gold k 1 1 1 distribution ggx alpha 1\n"),
     ":1:12: 'conductor' needs one of 'k R G B' and 'of METAL'"},
    {SCENE, BYTES("material m conductor of glod distribution ggx alpha 1\n"),
     ":1:25: 'glod' is no metal; did you mean 'gold'?"},
    {SCENE, BYTES("material m conductor eta 0 0 0 k 0 0 0 distribution ggx alpha 1\n"), ":1:10: "},
    {SCENE, BYTES("material m conductor of gold distribution ggx\n"),
     ":1:30: 'distribution ggx' needs 'alpha A' or 'alpha AX AY'"},
    {SCENE, BYTES("material m shape distribution ggx 2 alpha 1\n"),
     ":1:35: 'distribution ggx' takes nothing more"},
    {SCENE, BYTES("material m shape distribution slope alpha 1\n"),
     ":1:31: 'distribution slope' needs a formula between quotes"},
    {SCENE, BYTES("material m shape distribution slope \"exp(-\" alpha 1\n"), ":1:37: "},
    {SCENE, BYTES("material m shape distribution table none.vndf\n"), "none.vndf"},
    {SCENE, BYTES("image a pattern studio width 8 height 4\nmaterial m matte colour 1 1 1 colour-map a\n"),
     ":2:42: as colour the image must be from 0 to 1; it is "},
    {SCENE, BYTES("sphere centre 0 0 0 radius 1 material m\n"),
     ":1:39: 'm' is no material that is defined before this"},
    {SCENE, BYTES(GOLD "rectangle corner 0 0 0 edge-u 1 0 0 edge-v 1 1 0 material m\n"),
     "right angles; these are at 45 degrees"},
    {SCENE, BYTES(GOLD "rectangle corner 0 0 0 edge-u 0 0 0 edge-v 1 1 0 material m\n"),
     ":2:24: this edge has no length"},
    {SCENE, BYTES("material l light radiance 1 1 1\nmesh file none.obj material l\n"),
     ":2:29: a light is a sphere or a rectangle"},
    {SCENE, BYTES("camera \"from 0\n"), ":1:8: the quote that begins here does not end on its line"},
    {SCENE, BYTES("camera \"from\"x\n"), ":1:14: a blank is missing before this"},
    {SCENE, BYTES("camera \"from\" 0 0 5 to 0 0 0\n"), ":1:8: 'from' is no clause here"},
    {SCENE, BYTES("camera from 0 0 5 to 0 0 0 # more\n\001 1"), ":2:1: a byte 1, which is no text"},
};

static void test_refusals(void)
{
    char zero[] = "camera from 0 0 5 to 0 0 0\n\0 1";
    geometry g = {0};
    vndf_error error;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        refused(bad[i].kind, bad[i].bytes, bad[i].size, bad[i].says);
    TEST(!scene_read_text("z.scene", zero, sizeof zero - 1, &error));
    TEST_HAS(error.message, "z.scene:2:1: a byte 0, which is no text");
    TEST(!scene_read("no/such.scene", &error));
    TEST_HAS(error.message, "no/such.scene: No such file");
    TEST(!obj_read(&g, "no/such.obj", 0, &error));
    TEST_HAS(error.message, "no/such.obj: No such file");
}

static void test_words(void)
{
    scene *s =
        case_scene("# all kinds of blanks\r\ncamera\tfrom 0 0 5#eye\n  to 0 0 0\n\nenvironment constant 1 1 1");
    vndf_error error;
    TEST(s && s->to.z == 0 && s->from.z == 5);
    TEST(s && !scene_resize(s, 20000, &error) && scene_resize(s, 64, &error) && s->width == 64 && s->height == 36);
    scene_free(s);
}

int main(void)
{
    test_round_trip();
    test_forms();
    test_square(CORNERS "f 1/1 2/2 3/3 4/4\n");
    test_square(CORNERS "# a comment\no name\nf -4/-4 -3/-3 -2/-2 -1/-1 # more\r\n");
    test_square(CORNERS "f 1/1/1 2/2/1 3/3/1 4/4/1");
    test_square(CORNERS "f 4/4/1 3/3/1 2/2/1 1/1/1\n"); /* the other way round; normals win */
    test_placement();
    test_refusals();
    test_words();
    return test_done();
}
