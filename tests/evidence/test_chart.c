/* Charts are legible: ticks stand where axes say and have names, labels neither overlap nor leave the frame,
 * points outside the axes are left out, and a text cannot break the markup. */
#include "harness/test.h"

#include <stdlib.h>

#include "draw/chart.h"

enum { TEXT_SIZE = 1 << 16 };

/* ---- axes ---- */

static int named(const chart_tick *ticks, size_t count)
{
    int names = 0;
    for (size_t i = 0; i < count; i++)
        names += ticks[i].name[0] != '\0';
    return names;
}

static int has_tick(const chart_tick *ticks, size_t count, double value, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (fabs(ticks[i].value / value - 1) < 1e-9)
            return strcmp(ticks[i].name, name) == 0;
    return 0;
}

static int is_ascending(const chart_axis *axis, const chart_tick *ticks, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double place = chart_place(axis, ticks[i].value);
        if (!(place > -1e-6 && place < 1 + 1e-6) || (i > 0 && !(ticks[i].value > ticks[i - 1].value)))
            return 0;
    }
    return 1;
}

static void test_ticks(void)
{
    static const chart_axis wide = {CHART_LOG, 1e-7, 1, 0, ""}, narrow = {CHART_LOG, 3, 200, 0, ""},
                            bytes = {CHART_BYTES, 1900, 70000, 0, ""}, linear = {CHART_LINEAR, 0, 180, 30, ""},
                            huge = {CHART_LOG, 1e-30, 1e30, 0, ""};
    chart_tick t[CHART_TICKS_MAX];
    size_t n = chart_ticks(&wide, t);
    TEST(is_ascending(&wide, t, n) && named(t, n) == 8);
    TEST(has_tick(t, n, 1e-7, "10⁻⁷") && has_tick(t, n, 1, "1") && has_tick(t, n, 2e-3, ""));
    n = chart_ticks(&narrow, t);
    TEST(is_ascending(&narrow, t, n) && has_tick(t, n, 5, "5") && has_tick(t, n, 100, "100"));
    TEST(has_tick(t, n, 3, ""));
    n = chart_ticks(&bytes, t);
    TEST(is_ascending(&bytes, t, n) && n == 6 && has_tick(t, n, 2048, "2 KiB") && has_tick(t, n, 65536, "64 KiB"));
    n = chart_ticks(&linear, t);
    TEST(is_ascending(&linear, t, n) && n == 7 && strcmp(t[6].name, "180") == 0);
    n = chart_ticks(&huge, t);
    TEST(n <= CHART_TICKS_MAX && is_ascending(&huge, t, n));
}

static void test_fit(void)
{
    chart_axis axis = {CHART_LOG, 0, 0, 0, ""};
    chart_fit(&axis, 2e-5, 0.3);
    TEST_RELATIVE(axis.low, 1e-5, 1e-9);
    TEST_RELATIVE(axis.high, 1.0, 1e-9);
    chart_fit(&axis, 1e-3, 1e-3); /* one value still has a decade */
    TEST(axis.high / axis.low > 9.9 && axis.low <= 1.001e-3);
    chart_fit(&axis, (double)INFINITY, 0); /* none */
    TEST(axis.low > 0 && axis.high > axis.low && axis.high < 1e300);
}

/* ---- labels ---- */

typedef struct label {
    double x, y, width;
} label;

/* The places of the texts in a piece of markup. */
static size_t read_labels(const char *text, label *labels, size_t most)
{
    size_t count = 0;
    while (count < most && (text = strstr(text, "<text class=\"name")) != NULL) {
        char *end;
        const char *x = strstr(text, "x=\""), *y = strstr(text, "y=\"");
        labels[count].x = strtod(x + 3, &end);
        labels[count].y = strtod(y + 3, &end);
        text = strchr(text, '>') + 1;
        labels[count].width = 5 * (double)strcspn(text, "<"); /* at least */
        count++;
    }
    return count;
}

static int is_clear(const label *a, const label *b)
{
    return fabs(a->y - b->y) >= 10 || a->x + a->width <= b->x || b->x + b->width <= a->x;
}

static size_t read_back(FILE *file, char *text)
{
    rewind(file);
    size_t size = fread(text, 1, TEXT_SIZE - 1, file);
    text[size] = '\0';
    fclose(file);
    return size;
}

/* Eight points within 10 pixels of each other. */
static void test_crowd(char *text)
{
    static chart_taken taken;
    const chart_box bounds = {0, 0, 400, 300};
    unsigned long long state = 5;
    double x[8], y[8];
    label labels[16];
    FILE *file = tmpfile();
    if (!TEST(file))
        return;
    for (int i = 0; i < 8; i++) {
        x[i] = 200 + 10 * test_uniform_double(&state);
        y[i] = 150 + 10 * test_uniform_double(&state);
        chart_take(&taken, x[i], y[i], 4);
    }
    for (int i = 0; i < 8; i++)
        chart_label_beside(file, &taken, &bounds, x[i], y[i], 0, "16 KiB here");
    read_back(file, text);
    if (!TEST(read_labels(text, labels, 16) == 8))
        return;
    for (int i = 0; i < 8; i++) {
        TEST(labels[i].x >= 0 && labels[i].x + labels[i].width <= 400 && labels[i].y > 0 && labels[i].y < 300);
        for (int k = 0; k < i; k++)
            TEST(is_clear(&labels[i], &labels[k]));
    }
}

static void test_ends(char *text)
{
    chart_end ends[6];
    label labels[8];
    FILE *file = tmpfile();
    if (!TEST(file))
        return;
    for (int i = 0; i < 6; i++)
        ends[i] = (chart_end){100, 190 + (i % 2 ? 3.0 : 0.0), 0, 0, "end"};
    chart_label_ends(file, ends, 6, 120, 10, 200);
    read_back(file, text);
    if (!TEST(read_labels(text, labels, 8) == 6))
        return;
    for (int i = 0; i < 6; i++) {
        TEST(labels[i].y >= 10 && labels[i].y <= 206);
        TEST(i == 0 || labels[i].y - labels[i - 1].y > 14);
    }
}

/* ---- the whole ---- */

static int count_text(const char *text, const char *part)
{
    int count = 0;
    for (; (text = strstr(text, part)) != NULL; text++)
        count++;
    return count;
}

static void test_chart(char *text)
{
    static const double x[] = {1, 10, 100, 1000, 10}, y[] = {0.1, 0.01, (double)NAN, 0.1, 0};
    const chart_series series = {"a <b> & \"c\"", x, y, 5, 1, CHART_DOT, CHART_SOLID, NULL};
    chart c = {"title", NULL,    500, 300,  100, {CHART_LOG, 1, 100, 0, "x"}, {CHART_LOG, 1e-3, 1, 0, "y"}, "none",
               30,      &series, 1,   NULL, 0};
    FILE *file = tmpfile();
    if (!TEST(file))
        return;
    chart_draw_alone(file, &c);
    TEST(read_back(file, text) > 0);
    TEST(count_text(text, "<circle") == 3); /* two, and the zero in its band; neither NaN nor what is outside */
    TEST(!strstr(text, "<b>") && !strstr(text, "nan") && !strstr(text, "inf"));
    TEST_HAS(text, "a &lt;b&gt; &amp; &quot;c&quot;");
    TEST_HAS(text, "prefers-color-scheme:dark");
    TEST_HAS(text, ">none</text>");
}

int main(void)
{
    char *text = malloc(TEXT_SIZE);
    if (!TEST(text))
        return test_done();
    test_ticks();
    test_fit();
    test_crowd(text);
    test_ends(text);
    test_chart(text);
    free(text);
    return test_done();
}
