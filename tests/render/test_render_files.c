/* Files are what they say, and broken ones are refused with the place and the reason. Images of either byte
 * order, of one channel, with CR LF are read. A broken mesh adds nothing. Images lie upright on rectangles, around
 * spheres with the top at +y, on meshes, which are scaled, turned and moved, as vt say. Notices rows from the wrong
 * end, a byte order that is not swapped, sizes that are believed; indices off by one or taken from the wrong end,
 * polygons cut wrongly, u and v exchanged or flipped, normals that do not win over the order of corners. */
#include "render_case.h"

#define BYTES(literal) literal, sizeof literal - 1

/* ---- images ---- */

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

static int read_mesh(geometry *g, const char *text, vndf_error *error)
{
    char copy[CASE_TEXT];
    snprintf(copy, sizeof copy, "%s", text);
    return obj_read_text(g, "x.obj", copy, strlen(copy), 7, error);
}

static void test_square(const char *text)
{
    geometry g = {0};
    vndf_error error;
    if (!TEST(read_mesh(&g, text, &error) && g.count == 2 && geometry_build(&g)))
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

/* ---- refusals ---- */

enum { IMAGE, MESH };

#define PIXEL "\0\0\x80\x3f"
#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static const struct {
    int kind;
    const char *bytes;
    size_t size;
    const char *says;
} bad[] = {
    {IMAGE, BYTES("P4\n1 1\n255\n"), "this is no PFM, PGM or PPM image"},
    {IMAGE, BYTES("PF\n1 1\n"), "the head is not whole: after PF come width, height, a scale"},
    {IMAGE, BYTES("P6\n1 1\n65536\n123"), "'65536' must be the largest value, from 1 to 65535"},
    {IMAGE, BYTES("P5\n1 2\n256\n\0\0\1"), "1 x 2 pixels take 4 bytes after the head, and there are 3"},
    {IMAGE, BYTES("Pf\n0 1\n-1\n" PIXEL), "0 x 1 pixels: sides are from 1 to 16384"},
    {IMAGE, BYTES("Pf\n16384 16384\n-1\n" PIXEL), "and there are 33554432 pixels at most"},
    {IMAGE, BYTES("Pf\n1 1\n0\n" PIXEL), "'0' must be a number other than 0"},
    {IMAGE, BYTES("Pf\n2 1\n-1\n" PIXEL "\0\0\x80\x7f"), "the pixel in column 1 of row 0 (from the top, from 0)"},
    {MESH, BYTES(""), ": the file ends here without a triangle that has an area"},
    {MESH, BYTES("v 0\0 0"), " the file has a byte 0"},
    {MESH, BYTES("v 0 0 0\nv 1 0\n"), ":2: there are 2 numbers of 3 in this line"},
    {MESH, BYTES("v 0 0 nan\n"), ":1: 'nan' should be a number"},
    {MESH, BYTES("v 0 0 1e9\n"), ":1: numbers of 'v' lie within 1e+07 of 0, and these do not"},
    {MESH, BYTES(TRIANGLE "f 1 2\n"), ":4: a face has 3 corners or more, this one has 2"},
    {MESH, BYTES(TRIANGLE "f 1 2 4\n"), ":4: 4 is none of the 3 lines 'v' before this"},
    {MESH, BYTES(TRIANGLE "f 0 1 2\n"), ":4: 0 is none of the 3 lines 'v' before this, which are counted from 1"},
    {MESH, BYTES(TRIANGLE "f 1/1 2 3\n"), ":4: 1 is none of the 0 lines 'vt'"},
    {MESH, BYTES(TRIANGLE "f 1/ 2 3\n"), ":4: '1/' should be v, v/vt, v//vn or v/vt/vn, in numbers"},
    {MESH, BYTES(TRIANGLE "f 1a 2 3\n"), ":4: '1a' should be v, v/vt, v//vn or v/vt/vn"},
    {MESH, BYTES("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), ":4: the file ends here without a triangle"},
};

/* Nothing comes of the bytes, and the reason is said with the name and the place. */
static void test_refusals(void)
{
    static const char *const starts[] = {"x: ", "x.obj:"};
    geometry g = {0};
    vndf_error error;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char copy[256];
        image map = {.rgb = NULL};
        memcpy(copy, bad[i].bytes, bad[i].size + 1);
        const int good = bad[i].kind == IMAGE ? image_read_bytes(&map, "x", copy, bad[i].size, &error)
                                              : obj_read_text(&g, "x.obj", copy, bad[i].size, 7, &error);
        if (!(TEST(!good && !map.rgb && !g.count) & TEST_HAS(error.message, bad[i].says) &
              TEST_HAS(error.message, starts[bad[i].kind])))
            fprintf(stderr, "    %s    says %s\n", bad[i].bytes, error.message);
    }
    geometry_free(&g);
}

/* ---- where they lie ---- */

/* A PFM of red and green above blue and black. */
static int put_quarters(const char *name)
{
    image of;
    FILE *file = fopen(name, "wb");
    if (!file || !image_make(&of, 2, 2))
        return 0;
    of.rgb[0] = of.rgb[4] = of.rgb[8] = 1.0f;
    const int good = image_write_pfm(file, &of);
    image_free(&of);
    return fclose(file) == 0 && good;
}

/* The colours seen in the corners: 0 to 2, or 3 for none. */
static void test_upright(const char *shapes, const char *camera, const int want[4])
{
    char text[2048];
    snprintf(text, sizeof text,
             "%s --width 4 --height 4 --depth 1\nenvironment --constant 1,1,1\n"
             "material m --matte 1,1,1 --colour-map \"render_quarters.pfm\"\n%s",
             camera, shapes);
    scene *s = case_scene(text);
    film f = {.sum = NULL};
    case_render(&f, s, SAMPLER_VISIBLE, 64, 1);
    for (int i = 0; i < 4; i++) {
        static const size_t pixels[4] = {0, 3, 12, 15};
        const double *rgb = f.sum + 3 * pixels[i], most = 0.4 * 64;
        int colour = rgb[0] > most ? 0 : rgb[1] > most ? 1 : rgb[2] > most ? 2 : 3;
        if (!TEST(colour == want[i]))
            fprintf(stderr, "    %s    corner %d: %g %g %g\n", shapes, i, rgb[0] / 64, rgb[1] / 64, rgb[2] / 64);
    }
    film_free(&f);
    scene_free(s);
}

static void test_places(void)
{
    static const int upright[4] = {0, 1, 2, 3};
    FILE *mesh = fopen("render_quarters.obj", "w");
    if (!TEST(mesh && put_quarters("render_quarters.pfm")))
        return;
    fputs(
        "v 0 -1 2\nv 0 -1 1\nv 0 0 1\nv 0 0 2\nvn 2 0 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n",
        mesh);
    fclose(mesh);
    const char *camera = "camera --from 0,0,5 --to 0,0,0 --field 22";
    test_upright("rectangle --corner -1,-1,0 --edge-u 2,0,0 --edge-v 0,2,0 --material m\n", camera, upright);
    test_upright("\tmesh --file \"render_quarters.obj\" --scale 2 --turn -90 --move 3,1,0 --material m#\r\n",
                 camera, upright);
    /* around the sphere u goes from +z by way of +x: seen from -x its first half is behind, the seam at -z left */
    static const int from_x[4] = {0, 0, 2, 2}, from_minus_x[4] = {1, 1, 3, 3};
    test_upright("sphere --centre 0,0,0 --radius 1 --material m\n", "camera --from 5,0,0 --to 0,0,0 --field 18",
                 from_x);
    test_upright("sphere --centre 0,0,0 --radius 1 --material m\n", "camera --from -5,0,0 --to 0,0,0 --field 18",
                 from_minus_x);
    remove("render_quarters.pfm");
    remove("render_quarters.obj");
}

int main(void)
{
    test_forms();
    test_square(CORNERS "f 1/1 2/2 3/3 4/4\n");
    test_square(CORNERS "# a comment\no name\nf -4/-4 -3/-3 -2/-2 -1/-1 # more\r\n");
    test_square(CORNERS "f 1/1/1 2/2/1 3/3/1 4/4/1");
    test_square(CORNERS "f 4/4/1 3/3/1 2/2/1 1/1/1\n"); /* the other way round; normals win */
    test_refusals();
    test_places();
    return test_done();
}
