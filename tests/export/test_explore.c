/* `vndf explore` writes one page that asks the network for nothing and is the same each time, whatever its tables are
 * called; and in a headless Chromium, which compiles its shaders, what it draws and measures is right: the density
 * integrates to 1, drawn normals have the mean that it says, none is turned away, the spheres have light on them.
 * Without WebGL2 it says so, and a keyboard moves its sliders. Chromium takes a quarter of a minute for a setting where
 * no GPU is: long_explore has four of them, and what engines make of them in one pass is near what samples say. */
#include "harness/run_program.h"

#define SHIPPED VNDF_SOURCE_DIR "/tables/"

static const char *const parts[] = {" data-tv=\"0.0003",
                                    ">hazy</option>",
                                    ">a&amp;b</option>",
                                    "const int VNDF_STUDENT_T_2_5 = ",
                                    "What an engine makes of it in one pass",
                                    "vndf_sampled vndf_sample(vndf_view s, float u1, float u2) {"},
                         /* What is left of a frame, or may ask the network. */
    *const none[] = {"{{",    "a&b",     "http:",   "https:",  "src=",  "url(h",    "url(/",
                     "url('", "@import", "import(", "XMLHttp", "<link", "WebSocket"};

/* Two of them have an albedo by quadrature for both surfaces; those of 48 samples a pixel are not too grainy. */
static const char *const settings[] = {
    "a=hazy&b=ring&alpha=0.3&theta=60&frames=2",
    "a=student-t-2.5&b=beckmann&alpha=0.05,0.4&turn=30&theta=80&median=1&light=studio&material=glass&frames=2",
    "a=student-t-2.5&b=beckmann&alpha=0.3&theta=0&light=lamp&material=red&frames=1",
    "a=hazy&b=ggx&alpha=0.3&light=sky&frames=48"};

/* What a page measures, of the surfaces a and b where there is %c. */
static const struct {
    const char *name;
    double low, high;
    const char *of; /* part of the settings that it is for */
} measures[] = {
    {"drawn", 1, 48, ""},
    {"error", 0, 0, ""},
    {"dots", 0.3, 1, ""},
    {"miss", 0, 12, ""}, /* of 255 */
    {"%c_whole", 0.999, 1.001, ""},
    {"%c_truth", 0.999, 1.001, ""},
    {"%c_facing_to_density", 0.999, 1.001, ""},
    {"%c_faults", 0, 0, ""},
    {"a_off", 0, 1e-4, ""},
    {"%c_kept", 0.5, 1, ""},
    {"%c_light", 0.005, 2, ""},
    {"%c_spread", 0.02, 2, ""},
    {"%c_light_faults", 0, 0, ""},
    {"a_kept", 0.9841, 0.9881, "a=hazy"},
    {"b_kept", 0.8196, 0.8236, "b=ggx"},
    {"area_error", 0.001, 1, ""},
    {"sky_error", 0.001, 1, ""},
    {"area_error", 0.001, 0.08, "frames=48"},
    {"sky_error", 0.001, 0.08, "frames=48"},
};

#ifdef __SANITIZE_ADDRESS__
enum { DRAWS = 0 }; /* that would be the same without sanitizers */
#else
enum { DRAWS = 1 };
#endif

/* What Chromium makes of a page, with its scripts run; "none" where there is none. To be freed. */
static char *browse(const char *options, const char *setting)
{
    char command[1000];
    size_t size;
    snprintf(
        command, sizeof command,
        "rm -rf profile; for c in chromium chromium-browser google-chrome; do command -v $c >/dev/null && exec "
        "timeout -k 5 250 $c --headless --no-sandbox --hide-scrollbars --user-data-dir=profile "
        "--virtual-time-budget=1000 --window-size=520,700 %s --dump-dom \"file://$PWD/one.html#%s\" >dom "
        "2>/dev/null; done; echo none >dom",
        options, setting);
    TEST(system(command) >= 0);
    char *dom = run_file("dom", &size);
    TEST(dom && remove("dom") == 0);
    return dom;
}

static void judge(const char *dom, const char *setting)
{
    char name[40], key[60];
    for (size_t i = 0; i < 2 * (sizeof measures / sizeof *measures); i++) {
        const double low = measures[i / 2].low, high = measures[i / 2].high;
        snprintf(name, sizeof name, measures[i / 2].name, "ab"[i % 2]);
        snprintf(key, sizeof key, "&quot;%s&quot;:", name);
        const char *at = strstr(dom, key);
        const double value = at ? strtod(at + strlen(key), NULL) : -1;
        if (strstr(setting, measures[i / 2].of) && !TEST(value >= low && value <= high))
            fprintf(stderr, "  %s: %s is %g, not from %g to %g\n", setting, name, value, low, high);
    }
}

/* Each step of the keyboard moves a slider of roughness by one step, from end to end: a setting that is rounded and
 * written back must not take the step back. */
static const char steps[] =
    "<script>if (!gl) {\n"
    "listen(() => {}); const slider = byId('alpha-x'); let stuck = 0; slider.value = 0;\n"
    "for (let i = 1; i <= 200; i++) {\n"
    "slider.stepUp(); slider.dispatchEvent(new Event('input'));\n"
    "stuck += Math.abs(Number(slider.value) - i / 200) > 1e-6; }\n"
    "document.body.dataset.stuck = `${stuck} of 200, alpha ${settings.alpha[0]}`;\n"
    /* Where a normal lies on a disc the colour is that of its density, and dots are where drawn normals lie. */
    "} else if (settings.frames) {\n"
    "const number = (id) => Number(byId(id).textContent.match(/\\d[\\d.e-]*/)), root = document.documentElement;\n"
    "const pixel = (x, y) => {\n"
    "const canvas = byId('disc-a'), half = canvas.width / 2, angle = Math.asin(Math.hypot(x, y));\n"
    "const to = half * Math.sin(angle / 2) / Math.sin(radians(number('scale-says')) / 2) / Math.sin(angle);\n"
    "return canvas.getContext('2d').getImageData(half + to * x, half - to * y, 1, 1).data; };\n"
    "Object.assign(settings, {alpha: [0.2, 0.5], turn: 30}); drawStill();\n"
    "const dots = mean(says.a.samples.dots.map(([x, y]) => pixel(x, y)[2] < 60));\n"
    "settings.dots = false; drawStill(); measureSamples(surfaceOf(settings.a));\n"
    "const density = readTarget(targets.samples, 0)[1], [, , xs, ys] = readTarget(targets.samples, 1);\n"
    "const [low, high] = ['low', 'high'].map((end) => number(`scale-${end}`));\n"
    "const miss = density.filter((_, i) => i % 20 === 0).map((d, i) => {\n"
    "const at = clamped(5 * Math.log(d / low) / Math.log(high / low), 0, 4.999), k = Math.floor(at);\n"
    "const [from, to] = [0, 1].map((j) => RAMPS[theme()][k + j][1]);\n"
    "return Math.abs(from + (at - k) * (to - from) - pixel(xs[20 * i], ys[20 * i])[1]); });\n"
    "root.dataset.measured = JSON.stringify({...JSON.parse(root.dataset.measured), dots, miss: mean(miss)});\n"
    "}</script></body>";

/* What a browser makes of the page, with these scripts at its end; without one the test is skipped. */
static void look(char *text)
{
    char *body = strstr(text, "</body>");
    FILE *file = fopen("one.html", "w");
    TEST(body && file && fprintf(file, "%.*s%s%s", (int)(body - text), text, steps, body) > 0 &&
         fclose(file) == 0);
    char *dom = browse("--disable-3d-apis", "");
    const int runs = strcmp(dom, "none\n") != 0;
    if (runs) {
        TEST_HAS(dom, "This browser has no WebGL2");
        TEST_HAS(dom, "data-stuck=\"0 of 200, alpha 1\"");
    } else {
        puts("SKIPPED: no Chromium here to draw the page with");
    }
    free(dom);
    for (size_t i = 0; i < (test_long() ? 4 : 1) && runs; i++) {
        dom = browse("--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader", settings[i]);
        judge(dom, settings[i]);
        free(dom);
    }
    TEST(system("rm -rf profile") == 0);
}

int main(void)
{
    char folder[] = "explore.XXXXXX";
    size_t size;
    if (!run_begin(folder))
        return test_done();
    run_line(0, "",
             "cp " SHIPPED "student-t-2.5-small.vndf 'a&b.vndf'; vndf build --slope "
             "'exp(-((r-1)/0.001)^2)' -q -o ring.vndf; for page in one two; do vndf explore " SHIPPED
             "hazy.vndf ring.vndf 'a&b.vndf' " SHIPPED "student-t-2.5.vndf -q --engines %d -o $page.html; done; "
             "cmp one.html two.html && rm two.html *.vndf",
             test_long() ? 32 : 4);
    char *text = run_file("one.html", &size);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        TEST_HAS(text, parts[i]);
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        TEST(!strstr(text, none[i]));
    if (DRAWS)
        look(text);
    free(text);
    TEST(remove("one.html") == 0);
    return run_end(folder);
}
