/* Charts are legible: ticks stand where axes say and have names, labels neither overlap nor leave the frame,
 * points outside the axes are left out, and a text cannot break the markup. */
#include <stdlib.h>

#include "draw/chart.h"
#include "harness/test.h"

enum { TEXT_SIZE = 1 << 18, LABELS_MAX = 64 };

static char text[TEXT_SIZE];

/* What a chart draws, read back. */
static void draw(const chart *c)
{
    FILE *file = tmpfile();
    text[0] = '\0';
    if (!TEST(file != NULL))
        return;
    chart_draw_alone(file, c);
    rewind(file);
    text[fread(text, 1, TEXT_SIZE - 1, file)] = '\0';
    fclose(file);
}

static int count_text(const char *part)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)) != NULL; at++)
        count++;
    return count;
}

static chart chart_of(const chart_series *series, size_t count, chart_axis x, chart_axis y)
{
    return (chart){.title = "title",
                   .width = 500,
                   .height = 400,
                   .right = 100,
                   .x = x,
                   .y = y,
                   .series = series,
                   .count = count};
}

/* ---- axes ---- */

static void test_ticks(void)
{
    static const chart_axis wide = {CHART_LOG, 1e-7, 1, 0, "x"}, narrow = {CHART_LOG, 3, 200, 0, "x"},
                            bytes = {CHART_BYTES, 1900, 70000, 0, "x"}, linear = {CHART_LINEAR, 0, 180, 30, "x"};
    chart c = chart_of(NULL, 0, wide, narrow);
    draw(&c);
    TEST_HAS(text, ">10⁻⁷</text>");
    TEST(count_text("class=\"tick quiet\" text-anchor=\"middle\"") == 8); /* eight decades; 2 to 9 have no name */
    TEST_HAS(text, ">5</text>");
    TEST_HAS(text, ">100</text>");
    TEST(!strstr(text, ">3</text>"));
    c = chart_of(NULL, 0, bytes, linear);
    draw(&c);
    TEST(count_text("class=\"tick quiet\" text-anchor=\"middle\"") == 6);
    TEST_HAS(text, ">2 KiB</text>");
    TEST_HAS(text, ">64 KiB</text>");
    TEST(count_text("class=\"tick quiet\" text-anchor=\"end\"") == 7);
    TEST_HAS(text, ">180</text>");
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

/* The labels of curves and points lie apart and between left and right; how many there are. */
static int labels_are_clear(double left, double right)
{
    struct {
        double x, y, width;
    } label[LABELS_MAX];
    int count = 0;
    for (const char *at = text; (at = strstr(at, "<text class=\"name")) != NULL && count < LABELS_MAX; count++) {
        label[count].x = strtod(strstr(at, "x=\"") + 3, NULL);
        label[count].y = strtod(strstr(at, "y=\"") + 3, NULL);
        at = strchr(at, '>') + 1;
        label[count].width = 5 * (double)strcspn(at, "<"); /* at least */
        TEST(label[count].x >= left && label[count].x + label[count].width <= right);
        TEST(label[count].y > 0 && label[count].y < 400);
        for (int k = 0; k < count; k++)
            TEST(fabs(label[k].y - label[count].y) >= 7 || label[k].x + label[k].width <= label[count].x ||
                 label[count].x + label[count].width <= label[k].x);
    }
    return count;
}

/* `many` points within 10 pixels of each other: what cannot be told apart has no label. */
static void test_crowd(size_t many, int least)
{
    static const chart_axis axis = {CHART_LINEAR, 0, 1, 0.5, ""};
    unsigned long long state = 5;
    double x[40], y[40];
    const char *texts[40];
    for (size_t i = 0; i < many; i++) {
        x[i] = 0.5 + 0.03 * test_uniform_double(&state);
        y[i] = 0.5 + 0.03 * test_uniform_double(&state);
        texts[i] = "16 KiB here";
    }
    const chart_series series = {NULL, x, y, many, 0, CHART_DOT, CHART_NO_LINE, texts};
    chart c = chart_of(&series, 1, axis, axis);
    draw(&c);
    int found = labels_are_clear(66, 400);
    TEST(found >= least && found <= (int)many);
}

static void test_ends(void)
{
    static const chart_axis axis = {CHART_LINEAR, 0, 1, 0.5, ""};
    double x[2] = {0, 1}, y[6][2];
    chart_series series[6];
    for (int i = 0; i < 6; i++) {
        y[i][0] = 0;
        y[i][1] = 0.02 * i;
        series[i] = (chart_series){"end", x, y[i], 2, 0, CHART_NO_MARK, CHART_SOLID, NULL};
    }
    chart c = chart_of(series, 6, axis, axis);
    draw(&c);
    TEST(labels_are_clear(400, 500) == 6);
}

/* ---- the whole ---- */

static void test_chart(void)
{
    static const double x[] = {1, 10, 100, 1000, 10}, y[] = {0.1, 0.01, (double)NAN, 0.1, 0};
    const chart_series series = {"a <b> & \"c\"", x, y, 5, 1, CHART_DOT, CHART_SOLID, NULL};
    chart c =
        chart_of(&series, 1, (chart_axis){CHART_LOG, 1, 100, 0, "x"}, (chart_axis){CHART_LOG, 1e-3, 1, 0, "y"});
    c.zero = "none";
    c.band = 30;
    draw(&c);
    TEST(count_text("<circle") == 3); /* two, and the zero in its band; neither NaN nor what is outside */
    TEST(!strstr(text, "<b>") && !strstr(text, "nan") && !strstr(text, "inf"));
    TEST_HAS(text, "a &lt;b&gt; &amp; &quot;c&quot;");
    TEST_HAS(text, "prefers-color-scheme:dark");
    TEST_HAS(text, ">none</text>");
}

int main(void)
{
    test_ticks();
    test_fit();
    test_crowd(8, 8);
    test_crowd(40, 10);
    test_ends();
    test_chart();
    return test_done();
}
