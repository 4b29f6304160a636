/* What is wrong with a scene file is refused with the line and the column where it stands and what would be
 * right, and nothing is left behind: every statement and clause, bytes that are no text, and more than the
 * limits. */
#include "harness/test.h"

#include "render/scene_text.h"

typedef struct wrong {
    const char *text, *message; /* the message from its line on */
} wrong;

static void refused(const char *before, const wrong *w)
{
    scene s;
    char message[MESSAGE], text[4096], want[MESSAGE];
    snprintf(text, sizeof text, "%s%s", before, w->text);
    snprintf(want, sizeof want, "%s/tests/x.scene:%s", VNDF_SOURCE_DIR, w->message);
    int good = read_text(&s, text, message);
    if (!TEST(!good))
        scene_free(&s);
    if (!TEST(strncmp(message, want, strlen(want)) == 0))
        fprintf(stderr, "  of: %s\n  got:  %s\n  want: %s\n", w->text, message, want);
    TEST(s.materials == NULL && s.images == NULL); /* nothing is left */
}

/* Alone in their file. */
static const wrong words[] = {
    {"", "1:1: the scene ends without a camera"},
    {" camera from 0 0 1 to 0 0 0", "1:2: a statement begins in the first column"},
    {"# c\ntitle \"a b\n\"", "2:7: the quote that begins here does not end on its line"},
    {"title \"a\"b", "1:10: a blank is missing before this"},
    {"title a\"b\"", "1:8: a blank is missing before this"},
    {"title \x01", "1:7: a byte 1, which is no text"},
    {"title a\x7f", "1:8: a byte that is no text"},
    {"title", "1:1: 'title' takes one word"},
    {"title a b", "1:9: 'title' takes one word"},
    {"title a\n\ntitle b", "3:1: 'title' stands in this scene twice"},
    {"tilte a", "1:1: 'tilte' is no statement; did you mean 'title'?"},
    {"\"title\" a", "1:1: 'title' is no statement"},
    {"fnord", "1:1: 'fnord' is no statement; it must be one of: title, film, camera,"},
    {"camera from 0 0 1 to 0 0 0\n", "1:27: the scene ends without light"},
    {"environment constant 1 1 1", "1:27: the scene ends without a camera"},
    {"camera from 0 0 1 to 0 0 0\nenvironment constant 0 0 0", "2:27: the scene ends without light"},
};

static const wrong settings[] = {
    {"film width 10", "1:1: 'film' needs 'height PIXELS'"},
    {"film width 10 height", "1:21: the statement ends before all of 'height PIXELS' was there"},
    {"film width height 10", "1:19: '10' is no word of 'film'; it must be one of: width, height"},
    {"film width 10 hieght 10", "1:15: 'hieght' is no word of 'film'; did you mean 'height'?"},
    {"film width 10 height 10 width 10", "1:25: 'width' stands in this statement twice"},
    {"film width 0 height 10", "1:12: width is 0, it must be from 1 to 16384"},
    {"film width 1.5 height 10", "1:12: width is 1.5, it must be a whole number"},
    {"film width nan height 10", "1:12: 'nan' is no number; it must be 'width PIXELS'"},
    {"film width 0x10 height 10", "1:12: '0x10' is no number"},
    {"film width 16384 height 16384", "1:12: 16384 x 16384 pixels are more than"},
    {"camera from 0 0 1 to 0 0", "1:25: the statement ends before all of 'to X Y Z' was there"},
    {"camera from 0 0 1 to 0\n  0 z", "2:5: 'z' is no number; it must be 'to X Y Z'"},
    {"camera from 0 0 1 to 0 0 1", "1:19: the camera looks nowhere"},
    {"camera from 0 1 0 to 0 0 0", "1:19: the camera looks along 'up'"},
    {"camera from 0 0 1 to 0 0 0 up 0 0 0", "1:28: the camera looks along 'up'"},
    {"camera from 0 0 2e6 to 0 0 0", "1:17: from is 2000000, it must be from -1000000 to 1000000"},
    {"camera from 0 0 1 to 0 0 0 field 180", "1:34: field is 180, it must be from 1 to 170"},
    {"integrator depth 0", "1:18: depth is 0, it must be from 1"},
    {"integrator roulette 0", "1:21: roulette is 0"},
    {"integrator samples -1", "1:20: samples is -1"},
    {"integrator exposure 0", "1:21: exposure is 0"},
    {"environment", "1:1: 'environment' needs 'constant R G B' or 'image NAME'"},
    {"environment constant 1 1 -1", "1:26: constant is -1"},
    {"environment constant 1 1 1 turn 3", "1:28: 'turn' is of an image, and this statement has none"},
    {"environment image sky", "1:19: no image is defined before this, so 'sky' is none"},
    {"image sky pattern stars width 4 height 4\nenvironment image sk",
     "2:19: 'sk' is no image that is defined before"},
    {"image", "1:1: 'image' needs a name, as in 'image sky file sky.pfm'"},
    {"image \"\" pattern stars", "1:7: a name has 1 to 64 letters"},
    {"image sky", "1:1: 'image' needs one of 'file PATH' and 'pattern NAME'"},
    {"image sky file a.pfm pattern stars", "1:1: 'image' needs one of"},
    {"image sky pattern star", "1:19: there is no pattern 'star'; did you mean 'stars'?"},
    {"image sky file a.pfm width 3", "1:22: 'width' is of a pattern; a file has its own"},
    {"image sky file \"\"", "1:16: a path is empty"},
    {"image sky file none.pfm", "1:16: " VNDF_SOURCE_DIR "/tests/none.pfm: "},
    {"image sky file harness/test.h", "1:16: " VNDF_SOURCE_DIR "/tests/harness/test.h: this is no PFM image"},
    {"image a pattern ramp\nimage a pattern ramp", "2:7: there is an image 'a' already"},
    {"image a file corpus/pfm/grey\nenvironment image a",
     "2:19: as light the image must be from 0 to 1e+06; red is -0.5 in column 1 of row 1"},
    {"image a pattern ramp width 16384 height 16384", "1:17: 16384 x 16384 pixels are more than"},
};

/* In line 3, behind a camera and light. */
static const wrong materials[] = {
    {"material", "3:1: 'material' needs a name"},
    {"material a", "3:10: what 'a' is must stand here"},
    {"material a conducter", "3:12: 'conducter' is no choice for 'material'; did you mean 'conductor'?"},
    {"material a matte", "3:12: 'matte' needs 'colour R G B'"},
    {"material a matte colour 1 1 2", "3:29: colour is 2, it must be from 0 to 1"},
    {"material a matte color 1 1 1", "3:18: 'color' is no word of 'material'; did you mean 'colour'?"},
    {"material a matte colour 1 1 1 index 2", "3:31: 'index' does not go with 'matte'; it goes with: dielectric,"},
    {"material a matte colour 1 1 1\nmaterial a mirror", "4:10: there is a material 'a' already"},
    {"material a matte colour 1 1 1 colour-map b", "3:42: no image is defined before this"},
    {"material a light", "3:12: 'light' needs 'radiance R G B'"},
    {"material a glass", "3:12: 'glass' needs 'index N'"},
    {"material a glass index 0", "3:24: index is 0"},
    {"material a dielectric index 1.5 alpha 1", "3:12: 'dielectric' needs 'distribution ggx|"},
    {"material a dielectric index 1.5 distribution ggx",
     "3:33: 'distribution ggx' needs 'alpha A' or 'alpha AX AY'"},
    {"material a dielectric index 1.5 distribution gxx",
     "3:46: 'gxx' is no choice for 'distribution'; did you mean 'ggx'?"},
    {"material a dielectric index 1.5 distribution ggx 2 alpha 1", "3:50: 'distribution ggx' takes nothing more"},
    {"material a dielectric index 1.5 distribution table", "3:46: 'distribution table' needs a file"},
    {"material a dielectric index 1.5 distribution table x.vndf", "3:52: "},
    {"material a shape distribution family gggx", "3:38: "},
    {"material a shape distribution slope \"exp(-r\"", "3:37: "},
    {"material a shape distribution slope \"r-1\"", "3:37: "},
    {"material a shape distribution ggx alpha 1 bytes 4096", "3:43: 'bytes' is of tables that are made here"},
    {"material a shape distribution family ggx bytes 1", "3:48: bytes is 1, it must be from 2048"},
    {"material a shape distribution ggx alpha 0", "3:41: alpha is 0, it must be from"},
    {"material a shape distribution ggx alpha 1 x", "3:43: 'x' is no number; it must be 'alpha A or AX AY'"},
    {"material a shape distribution ggx alpha 1 1 1", "3:45: '1' is no word of 'material'"},
    {"material a conductor distribution ggx alpha 1", "3:12: 'conductor' needs 'of METAL', or 'eta R G B'"},
    {"material a conductor of tin distribution ggx alpha 1",
     "3:25: 'tin' is no choice for 'of'; it must be one of: gold"},
    {"material a conductor of gold k 1 1 1 distribution ggx alpha 1", "3:22: 'of' names a metal"},
    {"material a conductor eta 0 1 1 k 0 1 1 distribution ggx alpha 1", "3:10: eta[0] and k[0] are both 0"},
    {"material a reflector f0 0 0 0 lobes both distribution ggx alpha 1", "3:31: 'lobes both' needs 'index N'"},
    {"material a shape lobes both index 2 distribution ggx alpha 1",
     "3:10: lobes both and the kind is shape: nothing says"},
    {"material a dielectric index 2 normals bounded distribution ggx alpha 1",
     "3:10: normals bounded, normals that reflect to above the horizon: lobes must be reflection"},
    {"material a dielectric index 2 lobes reflection absorb 1 1 1 distribution ggx alpha 1",
     "3:48: 'absorb' is of what light passes"},
    {"material a shape distribution ggx alpha 1 order 3", "3:43: 'order' goes with 'scattering multiple'"},
    {"material a shape distribution ggx alpha 1 masking v-cavites",
     "3:51: 'v-cavites' is no choice for 'masking'; did you mean 'v-cavities'?"},
    {"material a shape distribution ggx alpha 1 rotation 361", "3:52: rotation is 361"},
    {"image m file corpus/pfm/grey\nmaterial a shape distribution ggx alpha 1 alpha-y-map m",
     "4:55: as roughness the image must be from 1e-06 to 1000; red is -0.5 in column 1 of row 1"},
    {"image m file corpus/pfm/grey\nmaterial a matte colour 1 1 1 colour-map m",
     "4:42: as colour the image must be from 0 to 1; red is"},
    {"material a shape distribution ggx matrix 1 2 2 4", "3:35: this matrix is singular, or nearly so"},
    {"material a shape distribution ggx matrix 1 2 2", "3:47: the statement ends before all of 'matrix"},
    {"material a shape distribution ggx matrix 1e4 0 0 1", "3:42: matrix is 10000, it must be from -1000"},
    {"material a shape distribution ggx matrix 1 0 0 1 rotation 3", "3:50: 'matrix' says roughness and axes"},
    {"material a shape distribution ggx alpha 1 matrix 1 0 0 1", "3:35: 'matrix' says roughness and axes"},
    {"material a shape distribution ggx mean 1 0", "3:18: 'distribution ggx' needs 'alpha A'"},
    {"material a shape distribution ggx alpha 1 mean 1e9 0", "3:48: mean is 1e+09, it must be from -1000"},
    {"material a mirror mean 1 0", "3:19: 'mean' does not go with 'mirror'; it goes with: conductor, dielectric,"},
    {"material a shape distribution ggx alpha 1 filtered 2", "3:43: 'filtered' is of a 'height-map' or"},
    {"material a shape distribution ggx alpha 1 scale 2", "3:43: 'scale' is of a 'height-map' or"},
    {"image m pattern ramp\nmaterial a shape distribution ggx alpha 1 height-map m normal-map m",
     "4:56: slopes come from one map"},
    {"image m pattern ramp width 8 height 6\nmaterial a shape distribution ggx alpha 1 height-map m filtered 4",
     "4:65: squares of 4 texels do not divide an image of 8 x 6"},
    {"image m pattern ramp\nmaterial a shape distribution ggx alpha 1 height-map m scale 1e5",
     "4:43: slopes of this map go up to "},
    {"image m pattern ramp\nmaterial a shape distribution ggx alpha 1 normal-map m",
     "4:54: a normal must not lie in the surface or below: blue is 0.10"},
    {"image m file corpus/pfm/grey\nmaterial a shape distribution ggx alpha 1 normal-map m",
     "4:54: as half a normal and 1/2 the image must be from 0 to 1; red is 2 in column 1 of row 0"},
    {"material a shape distribution ggx alpha 1 mean 1 0 scattering multiple",
     "3:10: the surface has mean slopes, several lobes or a family, which no walk knows: scattering must be single"},
    {"material a shape distribution ggx alpha 1 mean 1 0 normals all",
     "3:10: the surface has mean slopes, several lobes or a family, so normals must be visible"},
    {"material a shape distribution ggx alpha 1 mean 1 0 retroreflective",
     "3:10: the material is retroreflective, which is not reciprocal with mean slopes: leave out mean"},
    {"lobe", "3:1: 'lobe' needs a name, as in 'lobe haze distribution ggx alpha 0.4'"},
    {"lobe a", "3:6: 'lobe' needs 'distribution ggx|"},
    {"lobe a distribution ggx", "3:8: 'distribution ggx' needs 'alpha A'"},
    {"lobe a distribution ggx alpha 1 weight -1", "3:40: weight is -1, it must be from 0"},
    {"lobe a distribution ggx alpha 1 colour 1 1 1",
     "3:33: 'colour' does not go with 'lobe'; it goes with: conductor"},
    {"lobe a distribution ggx alpha 1\nlobe a distribution ggx alpha 1", "4:6: there is a lobe 'a' already"},
    {"image m file corpus/pfm/grey\nlobe a distribution ggx alpha 1 weight-map m",
     "4:44: as weight the image must be from 0 to 1e+06; red is -0.5"},
    {"material a shape mix b", "3:22: no lobe is defined before this, so 'b' is none"},
    {"lobe abc distribution ggx alpha 1\nmaterial a shape mix abd",
     "4:22: 'abd' is no lobe that is defined before"},
    {"lobe a distribution ggx alpha 1\nmaterial a shape mix a alpha 1",
     "4:24: 'alpha' is of one lobe; beside 'mix'"},
    {"lobe a distribution ggx alpha 1 weight 0\nmaterial a shape mix a a", "4:18: the weights of all lobes are 0"},
    {"lobe a distribution ggx alpha 1\nmaterial a shape mix a a a a a a a a a",
     "4:38: 'a' is no word of 'material'"},
    {"lobe a distribution ggx alpha 1\nmaterial a shape mix a a weight 1",
     "4:26: 'weight' does not go with 'shape'"},
    {"material a shape distribution ggx alpha 1 scattering turquin order 3",
     "3:62: 'order' goes with 'scattering m"},
    {"material a shape distribution ggx alpha 1 scattering kulla-conti",
     "3:54: 'kulla-conti' is no choice for 'scattering'; did you mean 'kulla-conty'?"},
    {"material a shape distribution ggx alpha 1 scattering turquin masking separable",
     "3:10: scattering turquin or kulla-conty, whose albedos have Smith's masking by height: masking must be "
     "height-correlated"},
    {"material a shape distribution ggx alpha 1 scattering kulla-conty mean 1 0",
     "3:10: scattering turquin or kulla-conty, whose albedos are of one distribution without mean slope: leave out "
     "mean, its maps, mix and families"},
    {"lobe a distribution ggx alpha 1\nmaterial a shape mix a a scattering turquin",
     "4:10: scattering turquin or kulla-conty, whose albedos are of one"},
    {"material a shape index 2 lobes transmission distribution ggx alpha 1 scattering turquin",
     "3:10: scattering turquin or kulla-conty: lobes must be reflection, or both of a dielectric"},
    {"material a dielectric index 1.0005 distribution ggx alpha 1 scattering turquin",
     "3:29: 'scattering turquin' needs an index farther than 0.001 from 1"},
    {"material a conductor eta 0 0 0 k 0 0 0 distribution ggx alpha 1 scattering turquin",
     "3:10: eta[0] and k[0] are both 0"},
    {"material a shape distribution family corpus/family/none.vndfs parameter 2", "3:38: "},
    {"material a shape distribution family corpus/family/short/../empty.vndfs",
     "3:18: 'distribution family corpus"},
    {"material a shape distribution family corpus/family/two.vndfs parameter 1.7",
     "3:72: parameter is 1.7, it must be from 1.8 to 3"},
    {"material a shape distribution family corpus/family/two.vndfs parameter 1.8 3",
     "3:76: 'parameter FROM TO' needs 'parameter-map IMAGE'"},
    {"image m pattern ramp\nmaterial a shape distribution family corpus/family/two.vndfs parameter 2 parameter-map m",
     "4:74: 'parameter-map' goes from one parameter to another"},
    {"image m file corpus/pfm/grey\n"
     "material a shape distribution family corpus/family/two.vndfs parameter 2 3 parameter-map m",
     "4:90: as the way from one parameter to the other the image must be from 0 to 1; red is "},
    {"material a shape distribution family corpus/family/two.vndfs parameter 2 bytes 4096",
     "3:74: 'bytes' is of tables that are made here"},
    {"material a shape distribution family corpus/family/two.vndfs parameter 2 retroreflective",
     "3:10: the material is retroreflective, which is not reciprocal with mean slopes: leave out mean"},
    {"material a shape distribution ggx alpha 1 parameter 2",
     "3:43: 'parameter' is of a family of tables, as in 'distribution family FILE.vndfs'"},
    {"lobe a distribution family corpus/family/two.vndfs parameter 2\nmaterial a shape mix a a a a a",
     "4:18: these are more than 8 lobes; a family counts as two"},
    {"material a shape distribution ggx alpha 1e999", "3:41: alpha is inf, it must be from"},
    {"image m pattern ramp\nmaterial a shape distribution ggx alpha 1 alpha-map m alpha-x-map m",
     "4:43: 'alpha-map' is"},
};

static const wrong shapes[] = {
    {"sphere centre 0 0 0 radius 1", "3:1: 'sphere' needs 'material NAME'"},
    {"sphere centre 0 0 0 radius 0 material m", "3:28: radius is 0, it must be from"},
    {"sphere centre 0 0 0 radius 1 material m", "3:39: no material is defined before this, so 'm' is none"},
    {"material mm mirror\nsphere centre 0 0 0 radius 1 material m",
     "4:39: 'm' is no material that is defined before"},
    {"rectangle corner 0 0 0 edge-u 1 0 0 edge-v 1 1 0 material m",
     "3:37: the edges of a rectangle must be at right angles; these are at 45 degrees"},
    {"rectangle corner 0 0 0 edge-u 0 0 0 edge-v 1 1 0 material m", "3:24: 'edge-u' has no length"},
    {"rectangle corner 0 0 0 edge-u 1 0 0 edge-v 0 0 0 material m", "3:37: 'edge-v' has no length"},
    {"material m mirror\nrectangle corner 0 0 0 edge-u 1 0 0 edge-v 0 1 0 material m height 1",
     "4:61: 'heights IMAGE' and 'height LENGTH' go together"},
    {"image i pattern ramp width 1025 height 1024\nmaterial m mirror\n"
     "rectangle corner 0 0 0 edge-u 1 0 0 edge-v 0 1 0 material m heights i height 1",
     "5:69: these are more than 1048576 pixels of heights"},
    {"box from 0 0 0 to 1 0 1 material m", "3:34: no material"},
    {"material m mirror\nbox from 0 0 0 to 1 0 1 material m", "4:16: the box is flat"},
    {"mesh file x.obj scale 0 material m", "3:23: scale is 0"},
    {"mesh material m", "3:1: 'mesh' needs 'file PATH'"},
    {"material m mirror\nmesh file none.obj material m", "4:11: "},
};

static void test_refusals(void)
{
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        refused("", &words[i]);
    for (size_t i = 0; i < sizeof settings / sizeof settings[0]; i++)
        refused("", &settings[i]);
    for (size_t i = 0; i < sizeof materials / sizeof materials[0]; i++)
        refused(LIT, &materials[i]);
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0]; i++)
        refused(LIT, &shapes[i]);
}

static void test_bytes(void)
{
    scene s;
    char message[MESSAGE], zero[] = "title a\n\0", tiny[8];
    TEST(!scene_read_text(&s, "z", zero, sizeof zero - 1, message, sizeof message));
    TEST_HAS(message, "z:2:1: a byte 0");
    TEST(!scene_read_text(&s, "a long name", zero, 8, tiny, sizeof tiny)); /* cut, not overrun */
    TEST(!scene_read(&s, VNDF_SOURCE_DIR "/tests/none.scene", message, sizeof message));
    TEST_HAS(message, "none.scene:1:1: ");
}

/* `count` statements, each with its number in it once or, behind dots and slashes, in its length. */
static void test_limit(const char *form, int count, int longer, const char *want)
{
    enum { ROOM = 1 << 19 };
    scene s;
    char message[MESSAGE], *text = malloc(ROOM);
    size_t length = (size_t)snprintf(text, ROOM, "%s", LIT);
    char dots[2 * 80 + 1] = "";
    for (int i = 0; i < count; i++) {
        length += (size_t)snprintf(text + length, ROOM - length, form, i, dots);
        if (longer)
            strcat(dots, "./");
    }
    int good = read_text(&s, text, message);
    TEST(good == (want == NULL));
    if (want)
        TEST_HAS(message, want);
    if (good)
        scene_free(&s);
    free(text);
}

static void test_limits(void)
{
    test_limit("image i%d pattern ramp width 1 height 1\n", 64, 0, NULL);
    test_limit("image i%d pattern ramp width 1 height 1\n", 65, 0, ":67:7: these are more than 64 images");
    test_limit("material m%d mirror\n", 4096, 0, NULL);
    test_limit("material m%d mirror\n", 4097, 0, ":4099:10: these are more than 4096 materials");
    test_limit("material m%d shape distribution table %s../tables/student-t-2.5-small.vndf\n", 64, 1, NULL);
    test_limit("material m%d shape distribution table %s../tables/student-t-2.5-small.vndf\n", 65, 1,
               "these are more than 64 tables");
}

/* A light is light only where a shape has it. */
static void test_light(void)
{
    static const char text[] = "camera from 0 0 5 to 0 0 0\n"
                               "material m light radiance 1 1 1\nmaterial n mirror\n%s";
    scene s;
    char message[MESSAGE], with[256];
    snprintf(with, sizeof with, text, "sphere centre 0 0 0 radius 1 material m\n");
    if (TEST(read_text(&s, with, message)))
        scene_free(&s);
    snprintf(with, sizeof with, text, "sphere centre 0 0 0 radius 1 material n\n");
    TEST(!read_text(&s, with, message));
    TEST_HAS(message, ":4:40: the scene ends without light");
}

int main(void)
{
    test_refusals();
    test_bytes();
    test_limits();
    test_light();
    return test_done();
}
