/* Files are what they say, and broken ones are refused with the place and the reason. A PFM that is written is
 * read back to the bit; files of either byte order, of one channel, with CR LF are read. Meshes are scaled,
 * turned and moved; a broken one adds nothing. Scenes that are wrong are refused with file, line, column and
 * what would be right. Notices rows from the wrong end, a byte order that is not swapped, sizes that are
 * believed; indices off by one or taken from the wrong end, polygons cut wrongly, v not flipped, normals that do
 * not win over the order of corners; clauses that are taken where they do not belong, numbers that are not
 * checked, words that are cut wrongly, and places that are off. */
#include "render_case.h"

/* ---- images ---- */

static void test_round_trip(void)
{
    static const float values[6][3] = {{0, -1, 1e-30f}, {1e30f, 0.1f, 3}, {4, 5, 6},
                                       {7, 8, 9},       {10, 11, 12},     {13, 14, 15}};
    image made, back;
    image_error error = {""};
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
#define BYTES(literal) literal, sizeof literal - 1
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
        image_error error = {""};
        if (TEST(image_read_bytes(&made, "x", forms[i].bytes, forms[i].size, &error)))
            TEST(memcmp(made.rgb, forms[i].rgb, (i ? 6 : 3) * sizeof(float)) == 0);
        image_free(&made);
    }
}

static void refuse_images(void)
{
#define PIXEL "\0\0\x80\x3f"
    static const struct {
        const char *bytes;
        size_t size;
        const char *says;
    } bad[] = {
        {"", 0, "x: this is no PFM, PGM or PPM image"},
        {"P4\n1 1\n255\n", 11, "x: this is no PFM, PGM or PPM image"},
        {"PF\n1 1\n", 7, "the head of the image is not whole: after PF come width, height, a scale and a blank"},
        {"P6\n1 1\n65536\n123", 15, "the largest value is '65536'; it must be from 1 to 65535"},
        {"P5\n1 2\n256\n\0\0\1", 14, "1 x 2 pixels take 4 bytes after the head, and there are 3"},
        {"Pf\n0 1\n-1\n" PIXEL, 14, "width 0 and height 1: both must be whole numbers"},
        {"Pf\n16384 16384\n-1\n" PIXEL, 22, "16384 x 16384 pixels are more than"},
        {"Pf\n1 1\n0\n" PIXEL, 13, "'0' must be a number other than 0"},
        {"Pf\n1 1\n-1\n" PIXEL "\0", 15, "1 x 1 pixels take 4 bytes after the head, and there are 5"},
        {"Pf\n2 1\n-1\n" PIXEL "\0\0\x80\x7f", 18,
         "the pixel in column 1 of row 0 (from the top, from 0) is not finite"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        image made;
        image_error error = {""};
        if (!(TEST(!image_read_bytes(&made, "x", bad[i].bytes, bad[i].size, &error) && !made.rgb) &
              TEST_HAS(error.message, bad[i].says)))
            fprintf(stderr, "    says %s\n", error.message);
    }
}

/* ---- meshes ---- */

static int read_text(geometry *g, const char *text, const placement *where, char message[256])
{
    message[0] = '\0';
    return obj_read_text(g, "x.obj", text, strlen(text), where, 7, message, 256);
}

static const placement as_it_is = {1, 0, {0, 0, 0}};

static void refuse_meshes(void)
{
    static const struct {
        const char *text, *says;
    } bad[] = {
        {"", "x.obj:1: the file ends here without a triangle that has an area"},
        {"v 0 0 0\nv 1 0\n", "x.obj:2: there are 2 numbers of 3 in this line"},
        {"v 0 0 nan\n", "x.obj:1: 'nan' should be a number"},
        {"v 0 0 1e99\n", "x.obj:1: corners (v) lie within 1e+07 of 0, and these do not"},
        {"v 0 0 1e9\n", "x.obj:1: corners (v) lie within 1e+07 of 0"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "x.obj:4: a face has 3 corners or more, this one has 2"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "x.obj:4: number 4 is none of 3 corners (v) so far"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
         "x.obj:4: number 0 is none of 3 corners (v) so far, which are counted from 1"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2 3\n", "x.obj:4: number 1 is none of 0 texture coordinates (vt)"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2 3\n", "x.obj:4: '1/' should be v, v/vt, v//vn or v/vt/vn, in numbers"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1a 2 3\n",
         "x.obj:4: '1a' should be v, v/vt, v//vn or v/vt/vn, and end there"},
        {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "x.obj:4: the file ends here without a triangle"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        geometry g = {0};
        char message[256];
        if (!(TEST(!read_text(&g, bad[i].text, &as_it_is, message)) & TEST_HAS(message, bad[i].says) &
              TEST(g.count == 0)))
            fprintf(stderr, "    %s    says %s\n", bad[i].text, message);
        geometry_free(&g);
    }
    geometry g = {0};
    char message[256];
    TEST(!obj_read_text(&g, "x.obj", "v 0\0 0", 6, &as_it_is, 0, message, sizeof message));
    TEST_HAS(message, "x.obj:1: the file has a byte 0");
    TEST(!obj_read(&g, "no/such.obj", &as_it_is, 0, message, sizeof message));
    TEST_HAS(message, "no/such.obj: No such file");
}

static void test_square(const char *text)
{
    geometry g = {0};
    char message[256];
    if (!TEST(read_text(&g, text, &as_it_is, message)) || !TEST(g.count == 2 && geometry_build(&g))) {
        fprintf(stderr, "    %s    says %s\n", text, message);
        return;
    }
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

/* A quarter turn takes z to x. */
static void test_placement(void)
{
    const placement where = {2, 90, {10, 20, 30}};
    geometry g = {0};
    char message[256];
    TEST(read_text(&g, "v 0 0 1\nv 0 0 2\nv 0 1 1\nvn 0 0 3\nf 1//1 2//1 3//1\n", &where, message) &&
         g.count == 1);
    TEST_NEAR(g.shapes[0].corner.x, 12, 1e-12);
    TEST_NEAR(g.shapes[0].corner.y, 20, 1e-12);
    TEST_NEAR(g.shapes[0].corner.z, 30, 1e-12);
    TEST_NEAR((double)g.shapes[0].normal[0].x, 1, 1e-6);
    geometry_free(&g);
}

/* ---- scenes ---- */

#define LIT "camera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
#define GOLD "material m conductor of gold distribution ggx alpha 0.2\n"

static const struct {
    const char *text, *says;
} bad_scenes[] = {
    {"", ":1:1: the scene ends without a camera"},
    {"camera from 0 0 5 to 0 0 0\n", ":1:26: the scene ends without light"},
    {LIT "light from 1\n", ":3:1: 'light' is no statement; it must be one of: film, camera"},
    {LIT "spere centre 0 0 0\n", ":3:1: 'spere' is no statement; did you mean 'sphere'?"},
    {" camera from 0 0 5 to 0 0 0\n", ":1:2: a statement begins in the first column"},
    {LIT "camera from 0 0 5 to 0 0 0\n", ":3:1: 'camera' stands in this scene twice"},
    {"camera from 0 0 5\n", ":1:1: 'camera' needs 'to X Y Z'"},
    {"camera from 0 0 5 to 0 0 from 1 2 3\n", ":1:26: 'from' is no number; it must be 'to X Y Z'"},
    {"camera from 0 0 5 to 0 0 0 from 1 2 3\n", ":1:28: 'from' stands in this statement twice"},
    {"camera from 0 0 5 to 0 0\n", ":1:19: the statement ends before all of 'to X Y Z' was there"},
    {"camera from 0 0 nan to 0 0 0\n", ":1:17: 'nan' is no number"},
    {"camera from 0 0 1e7 to 0 0 0\n", ":1:17: from is 10000000, it must be from -1000000 to 1000000"},
    {"camera from 0 0 5 to 0 0 5\n", ":1:19: 'from' and 'to' are the same place"},
    {"camera from 0 5 0 to 0 0 0\n", ":1:1: 'up' is the direction of the view"},
    {"camera from 0 0 5 to 0 0 0 fild 3\n", ":1:28: 'fild' is no clause here; did you mean 'field'?"},
    {"film width 1.5 height 3\n", ":1:12: width is 1.5, it must be a whole number"},
    {"film width 16384 height 16384\n", ":1:6: 16384 x 16384 pixels are more than"},
    {"environment scale 2\n", ":1:1: 'environment' needs one of 'constant R G B' and 'image NAME'"},
    {"environment constant 1 1 1 turn 3\n", ":1:28: 'turn' stands beside 'image' only"},
    {"image a pattern tils\n", ":1:17: there is no pattern 'tils', but tiles, grid and studio"},
    {"image a file none.pfm\n", "none.pfm: No such file"},
    {"image a pattern tiles\nimage a pattern grid\n", ":2:7: there is another image 'a' already"},
    {"image a\n", ":1:1: 'image' needs a name and what it is"},
    {GOLD GOLD, ":2:10: there is another material 'm' already"},
    {"material m matte\n", ":1:12: 'matte' needs 'colour R G B'"},
    {"material m matte colour 1 1 1 alpha 2\n",
     ":1:31: 'alpha' is no clause here; it must be one of: colour, colour-map"},
    {"material m conductor distribution ggx alpha 1\n",
     ":1:12: 'conductor' needs one of 'of METAL' and 'eta R G B'"},
    {"material m conductor of gold k 1 1 1 distribution ggx alpha 1\n",
     ":1:12: 'conductor' needs one of 'k R G B' and 'of METAL'"},
    {"material m conductor of glod distribution ggx alpha 1\n", ":1:25: 'glod' is no metal; did you mean 'gold'?"},
    {"material m conductor eta 0 0 0 k 0 0 0 distribution ggx alpha 1\n", ":1:10: "},
    {"material m conductor of gold distribution ggx\n",
     ":1:30: 'distribution ggx' needs 'alpha A' or 'alpha AX AY'"},
    {"material m shape distribution ggx 2 alpha 1\n", ":1:35: 'distribution ggx' takes nothing more"},
    {"material m shape distribution ggx alpha 1 bytes 4096\n", ":1:43: 'bytes' is of tables that are made here"},
    {"material m shape distribution slope alpha 1\n",
     ":1:31: 'distribution slope' needs a formula between quotes"},
    {"material m shape distribution slope \"exp(-\" alpha 1\n", ":1:37: "},
    {"material m shape distribution table none.vndf\n", "none.vndf"},
    {"image a pattern studio width 8 height 4\nmaterial m matte colour 1 1 1 colour-map a\n",
     ":2:42: as colour the image must be from 0 to 1; it is "},
    {"sphere centre 0 0 0 radius 1 material m\n", ":1:39: 'm' is no material that is defined before this"},
    {GOLD "rectangle corner 0 0 0 edge-u 1 0 0 edge-v 1 1 0 material m\n",
     "right angles; these are at 45 degrees"},
    {GOLD "rectangle corner 0 0 0 edge-u 0 0 0 edge-v 1 1 0 material m\n", ":2:24: this edge has no length"},
    {"material l light radiance 1 1 1\nmesh file none.obj material l\n",
     ":2:29: a light is a sphere or a rectangle"},
    {"camera \"from 0\n", ":1:8: the quote that begins here does not end on its line"},
    {"camera \"from\"x\n", ":1:14: a blank is missing before this"},
    {"camera \"from\" 0 0 5 to 0 0 0\n", ":1:8: 'from' is no clause here"},
};

static void refuse_scenes(void)
{
    char message[1024], zero[] = "camera from 0 0 5 to 0 0 0\n\0 1";
    for (size_t i = 0; i < sizeof bad_scenes / sizeof *bad_scenes; i++) {
        scene *s = case_read(bad_scenes[i].text, message);
        if (!(TEST(!s) & TEST_HAS(message, bad_scenes[i].says) & TEST_HAS(message, "/tests/x.scene:")))
            fprintf(stderr, "    %s    says: %s\n", bad_scenes[i].text, message);
        scene_free(s);
    }
    TEST(!scene_read_text("z.scene", zero, sizeof zero - 1, message, sizeof message));
    TEST_HAS(message, "z.scene:2:1: a byte 0, which is no text");
    TEST(!scene_read("no/such.scene", message, sizeof message));
    TEST_HAS(message, "no/such.scene: No such file");
    scene *good =
        case_scene("# all kinds of blanks\r\ncamera\tfrom 0 0 5#eye\n  to 0 0 0\n\nenvironment constant 1 1 1");
    TEST(good && good->to.z == 0 && good->from.z == 5);
    TEST(good && !scene_resize(good, 20000, message, sizeof message) &&
         scene_resize(good, 64, message, sizeof message));
    TEST(good && good->width == 64 && good->height == 36);
    scene_free(good);
}

int main(void)
{
    test_round_trip();
    test_forms();
    refuse_images();
#define CORNERS "v 0 0 0\nv 1 0 0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 9\n"
    refuse_meshes();
    test_square(CORNERS "f 1/1 2/2 3/3 4/4\n");
    test_square(CORNERS "# a comment\no name\nf -4/-4 -3/-3 -2/-2 -1/-1 # more\r\n");
    test_square(CORNERS "f 1/1/1 2/2/1 3/3/1 4/4/1");
    test_square(CORNERS "f 4/4/1 3/3/1 2/2/1 1/1/1\n"); /* the other way round; normals win */
    test_placement();
    refuse_scenes();
    return test_done();
}
