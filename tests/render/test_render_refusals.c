/* Scenes that are wrong are refused with file, line, column and what would be right; nothing that is left of them
 * is used. Notices clauses that are taken where they do not belong, numbers that are not checked, words that are
 * cut wrongly, and places that are off. */
#include "render_case.h"

#define LIT "camera from 0 0 5 to 0 0 0\nenvironment constant 1 1 1\n"
#define GOLD "material m conductor of gold distribution ggx alpha 0.2\n"

static const struct {
    const char *text, *says;
} bad[] = {
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
    {"camera from 0 0 1-2 to 0 0 0\n", ":1:17: '1-2' is no number"},
    {"camera from 0 0 1e7 to 0 0 0\n", ":1:17: from is 10000000, it must be from -1000000 to 1000000"},
    {"camera from 0 0 5 to 0 0 5\n", ":1:19: 'from' and 'to' are the same place"},
    {"camera from 0 5 0 to 0 0 0\n", ":1:1: 'up' is the direction of the view"},
    {"camera from 0 0 5 to 0 0 0 fild 3\n", ":1:28: 'fild' is no clause here; did you mean 'field'?"},
    {"film width 1.5 height 3\n", ":1:12: width is 1.5, it must be a whole number"},
    {"film width 16384 height 16384\n", ":1:6: 16384 x 16384 pixels are more than"},
    {"integrator depth 0\n", ":1:18: depth is 0, it must be from 1 to 10000"},
    {"environment scale 2\n", ":1:1: 'environment' needs one of 'constant R G B' and 'image NAME'"},
    {"environment constant 1 1 1 turn 3\n", ":1:28: 'turn' is of an image"},
    {"environment image sky\n",
     ":1:19: 'sky' is no image that is defined before this; it must be one of: (none yet)"},
    {"image a pattern tils\n", ":1:17: there is no pattern 'tils'; did you mean tiles"},
    {"image a pattern tiles width 0\n", ":1:29: width is 0, it must be from 1 to 16384"},
    {"image a file none.pfm\n", "none.pfm: No such file"},
    {"image a file none.pfm width 3\n", ":1:23: 'width' is of a pattern; a file has its own"},
    {"image a pattern tiles\nimage a pattern grid\n", ":2:7: there is an image 'a' already"},
    {"image a\n", ":1:1: 'image' needs a name and what it is"},
    {GOLD GOLD, ":2:10: there is a material 'm' already"},
    {"material m metal of gold\n",
     ":1:12: 'metal' is no kind of material; it must be one of: conductor, dielectric"},
    {"material m matte\n", ":1:12: 'matte' needs 'colour R G B'"},
    {"material m matte colour 1 1 2\n", ":1:29: colour is 2, it must be from 0 to 1"},
    {"material m matte colour 1 1 1 alpha 2\n", ":1:31: 'alpha' does not go with 'matte'"},
    {"material m conductor distribution ggx alpha 1\n", ":1:12: 'conductor' needs 'of METAL', or 'eta R G B'"},
    {"material m conductor of gold k 1 1 1 distribution ggx alpha 1\n", ":1:12: 'conductor' needs 'of METAL'"},
    {"material m conductor of glod distribution ggx alpha 1\n", ":1:25: 'glod' is no metal; did you mean 'gold'?"},
    {"material m conductor eta 0 0 0 k 0 0 0 distribution ggx alpha 1\n", ":1:10: "},
    {"material m dielectric distribution ggx alpha 1\n", ":1:12: 'dielectric' needs 'index N'"},
    {"material m conductor of gold distribution ggx\n",
     ":1:30: 'distribution ggx' needs 'alpha A' or 'alpha AX AY'"},
    {"material m conductor of gold distribution ggx alpha 0\n",
     ":1:53: alpha is 0, it must be from 1e-06 to 1000"},
    {"material m shape distribution ggx 2 alpha 1\n", ":1:35: 'distribution ggx' takes nothing more"},
    {"material m shape distribution ggx alpha 1 bytes 4096\n", ":1:43: 'bytes' is of tables that are made here"},
    {"material m shape distribution slope alpha 1\n",
     ":1:31: 'distribution slope' needs a formula between quotes"},
    {"material m shape distribution slope \"exp(-\" alpha 1\n", ":1:37: "},
    {"material m shape distribution table none.vndf\n", "none.vndf"},
    {"material m shape distribution gx alpha 1\n", ":1:31: 'gx' is no distribution; did you mean 'ggx'?"},
    {"image a pattern studio width 8 height 4\nmaterial m matte colour 1 1 1 colour-map a\n",
     ":2:42: as colour the image must be from 0 to 1; it is "},
    {"sphere centre 0 0 0 radius 1 material m\n", ":1:39: 'm' is no material that is defined before this"},
    {GOLD "sphere centre 0 0 0 radius 0 material m\n", ":2:28: radius is 0, it must be from 1e-06"},
    {GOLD "rectangle corner 0 0 0 edge-u 1 0 0 edge-v 1 1 0 material m\n",
     "right angles; these are at 45 degrees"},
    {GOLD "rectangle corner 0 0 0 edge-u 0 0 0 edge-v 1 1 0 material m\n", ":2:24: 'edge-u' has no length"},
    {GOLD "mesh file none.obj material m\n", ":2:11: "},
    {"material l light radiance 1 1 1\nmesh file none.obj material l\n",
     ":2:29: a light is a sphere or a rectangle"},
    {"camera \"from 0\n", ":1:8: the quote that begins here does not end on its line"},
    {"camera \"from\"x\n", ":1:14: a blank is missing before this"},
    {"camera fr\001om\n", ":1:10: a blank is missing before this"},
    {"camera \"from\" 0 0 5 to 0 0 0\n", ":1:8: 'from' is no clause here"},
};

int main(void)
{
    char message[1024], zero[] = "camera from 0 0 5 to 0 0 0\n\0 1";
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        scene *s = case_read(bad[i].text, message);
        if (!(TEST(!s) & TEST_HAS(message, bad[i].says) & TEST_HAS(message, "/tests/x.scene:")))
            fprintf(stderr, "    %s    says: %s\n", bad[i].text, message);
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
    return test_done();
}
