/* Ticks. Linear axes have one every step. Logarithmic ones have decades with names, and small ticks at 2 to 9
 * between; where fewer than three decades are shown, 2 and 5 have names too. Bytes have powers of two, every
 * second of them named where there are many. */
#include "draw/chart.h"

#include <math.h>
#include <string.h>

#include "draw/table.h"

double chart_place(const chart_axis *axis, double value)
{
    if (axis->scale == CHART_LINEAR)
        return (value - axis->low) / (axis->high - axis->low);
    return value > 0 ? log(value / axis->low) / log(axis->high / axis->low) : (double)NAN;
}

void chart_fit(chart_axis *axis, double low, double high)
{
    double base = axis->scale == CHART_BYTES ? 2 : 10;
    double loose = axis->scale == CHART_BYTES ? 0.06 : 1e-3; /* files stay a little below what they may have */
    double first = floor(log(low) / log(base) + loose), last = ceil(log(high) / log(base) - loose);
    if (!(low > 0 && low <= high && high < HUGE_VAL)) /* nothing is known */
        first = -1, last = 0;
    double room = axis->scale == CHART_BYTES ? 1.15 : 1;
    axis->low = pow(base, first) / room;
    axis->high = pow(base, last > first ? last : first + 1) * room;
}

void chart_widen(chart_range *range, double value)
{
    if (!(value > 0))
        return;
    range->low = fmin(range->low, value);
    range->high = fmax(range->high, value);
}

void chart_fit_series(chart *c, double least)
{
    chart_range x = {HUGE_VAL, 0}, y = {HUGE_VAL, 0};
    for (size_t k = 0; k < c->count; k++)
        for (size_t i = 0; i < c->series[k].count; i++) {
            chart_widen(&x, c->series[k].x[i]);
            chart_widen(&y, c->series[k].y[i]);
        }
    if (!(c->x.high > c->x.low))
        chart_fit(&c->x, x.low, x.high);
    if (!(c->y.high > c->y.low))
        chart_fit(&c->y, fmax(y.low, least), y.high);
}

/* 10 to a power, with the digits above the line. */
static void name_power(char name[16], int power)
{
    static const char *const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    int size = power < 0 ? -power : power;
    snprintf(name, 16, "10%s%s%s", power < 0 ? "⁻" : "", size > 9 ? digits[size / 10 % 10] : "",
             digits[size % 10]);
}

/* Powers on an axis that needs them, plain numbers on one that does not. */
static void name_number(const chart_axis *axis, char name[16], double value)
{
    double power = floor(log10(value) + 1e-9);
    int is_wide = axis->low < 9e-4 || axis->high > 2e5;
    if (is_wide && fabs(value / pow(10, power) - 1) < 1e-9 && power != 0)
        name_power(name, (int)power);
    else
        snprintf(name, 16, "%.6g", value);
}

static size_t add_tick(const chart_axis *axis, chart_tick *ticks, size_t count, double value, int named)
{
    double place = chart_place(axis, value);
    if (count == CHART_TICKS_MAX || !(place > -1e-9 && place < 1 + 1e-9))
        return count;
    ticks[count].value = value;
    ticks[count].name[0] = '\0';
    if (named && axis->scale == CHART_BYTES)
        table_bytes_text(ticks[count].name, value);
    else if (named && axis->scale == CHART_LOG)
        name_number(axis, ticks[count].name, value);
    else if (named)
        snprintf(ticks[count].name, sizeof ticks[count].name, "%.4g", value);
    return count + 1;
}

static size_t decade_ticks(const chart_axis *axis, chart_tick ticks[CHART_TICKS_MAX])
{
    double decades = log10(axis->high / axis->low);
    size_t count = 0;
    for (int power = (int)floor(log10(axis->low)); power <= (int)ceil(log10(axis->high)); power++) {
        int every = decades > 9 ? 2 : 1;
        for (int digit = 1; digit <= 9; digit++) {
            int named = digit == 1 ? power % every == 0 : decades < 2.5 && (digit == 2 || digit == 5);
            count = add_tick(axis, ticks, count, digit * pow(10, power), named);
        }
    }
    return count;
}

static size_t byte_ticks(const chart_axis *axis, chart_tick ticks[CHART_TICKS_MAX])
{
    size_t count = 0;
    int first = (int)ceil(log2(axis->low) - 1e-9), last = (int)floor(log2(axis->high) + 1e-9);
    int every = last - first > 7 ? 2 : 1;
    for (int power = first; power <= last; power++)
        count = add_tick(axis, ticks, count, pow(2, power), (power - 11) % every == 0);
    return count;
}

size_t chart_ticks(const chart_axis *axis, chart_tick ticks[CHART_TICKS_MAX])
{
    size_t count = 0;
    if (axis->scale == CHART_LOG)
        return decade_ticks(axis, ticks);
    if (axis->scale == CHART_BYTES)
        return byte_ticks(axis, ticks);
    for (double i = ceil(axis->low / axis->step); i * axis->step <= axis->high * (1 + 1e-9); i++)
        count = add_tick(axis, ticks, count, i * axis->step, 1);
    return count;
}
