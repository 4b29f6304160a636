/* Images lie as they are meant to: upright on rectangles, around spheres with the top at +y, on meshes, which are
 * scaled, turned and moved, as vt say. Notices u and v exchanged or flipped, and half a pixel. */
#include "render_case.h"

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

int main(void)
{
    static const int upright[4] = {0, 1, 2, 3};
    FILE *mesh = fopen("render_quarters.obj", "w");
    if (!TEST(mesh && put_quarters("render_quarters.pfm")))
        return test_done();
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
    return test_done();
}
