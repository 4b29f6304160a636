/* Tables of perfect sampling: nodes, their cells, and drawing from a mixture of nodes.
 *
 *   axes      from a direction to a place among the nodes, and (by bisection, when nodes are made) back
 *   filling   turns the worth of cells into sums: over rows, and in each row over its cells
 *   drawing   chooses a node, a row, a cell in the row; the rest of each number is the place in it
 *
 * The sums are floats. The probability of a cell is their difference, hence the probability of really drawing
 * it. */
#include "render/perfect/table.h"

#include <stdlib.h>
#include <string.h>

enum { CELLS = PERFECT_CELLS, TILTS = 33, TURNS = 9, BISECTIONS = 40 };

static const float half_pi = 1.57079633f, least_worth = 3e-4f;
static const float last_tilt = 0.9995f; /* grazing itself sees nothing */

/* ---- axes ---- */

/* Rises from 0 to 1 with the sine, fastest about the critical sine. */
static float critical_rise(float critical, float width, float sine)
{
    float at = (sine - critical) / width, first = critical / width, last = (1.0f - critical) / width;
    float low = -first / (1.0f + first), high = last / (1.0f + last);
    return (at / (1.0f + fabsf(at)) - low) / (high - low);
}

static float tilt_of(const perfect_table *t, vndf_vec3 w)
{
    float x = t->alpha_x * w.x, y = t->alpha_y * w.y, z = fabsf(w.z), critical = t->critical[w.z < 0.0f];
    float across = sqrtf(w.x * w.x + w.y * w.y), stretched = sqrtf(x * x + y * y);
    float sum = across / (1.0f + z) + stretched / fmaxf(sqrtf(stretched * stretched + z * z) + z, 1e-30f);
    if (!(critical > 0.0f))
        return sum / (2.0f * last_tilt);
    float width = fmaxf(0.5f * stretched / fmaxf(across, 1e-30f), 1e-3f);
    return (sum + critical_rise(critical, width, across)) / (3.0f * last_tilt);
}

static float share_of(float x, float y)
{
    return x + y > 0.0f ? y / (x + y) : 0.0f;
}

static float turn_of(const perfect_table *t, vndf_vec3 w)
{
    return 0.5f * (share_of(w.x, w.y) + share_of(t->alpha_x * w.x, t->alpha_y * w.y));
}

static vndf_vec3 toward(float turn, float tilt)
{
    return vec(sinf(tilt) * cosf(turn), sinf(tilt) * sinf(turn), cosf(tilt));
}

/* The angle, of a quarter turn, where a coordinate is `at`. */
static float turn_at(const perfect_table *t, float at)
{
    float low = 0.0f, high = half_pi;
    for (int i = 0; i < BISECTIONS && at > 0.0f; i++) {
        float middle = 0.5f * (low + high);
        if (turn_of(t, toward(middle, half_pi)) < at)
            low = middle;
        else
            high = middle;
    }
    return at > 0.0f ? high : 0.0f;
}

/* The direction with this side, tilt and turn. */
static vndf_vec3 tilted(const perfect_table *t, float side, float turn, float at)
{
    float low = 0.0f, high = at > 0.0f ? half_pi : 0.0f;
    vndf_vec3 w = toward(turn, low);
    for (int i = 0; i < BISECTIONS; i++) {
        w = toward(turn, 0.5f * (low + high));
        w.z *= side;
        if (tilt_of(t, w) < at)
            low = 0.5f * (low + high);
        else
            high = 0.5f * (low + high);
    }
    return w;
}

/* ---- nodes ---- */

static size_t node_size(const perfect_table *t)
{
    return CELLS + (size_t)t->lobes * CELLS * CELLS;
}

size_t perfect_table_nodes(const perfect_table *t)
{
    return (size_t)t->sides * (size_t)t->turns * TILTS;
}

size_t perfect_table_bytes(const perfect_table *t)
{
    return perfect_table_nodes(t) * node_size(t) * sizeof *t->nodes;
}

int perfect_table_make(perfect_table *t)
{
    t->turns = t->alpha_x == t->alpha_y ? 1 : TURNS;
    t->nodes = malloc(perfect_table_bytes(t));
    return t->nodes != NULL;
}

void perfect_table_free(perfect_table *t)
{
    free(t->nodes);
    t->nodes = NULL;
}

/* Nodes are ordered by side, turn, tilt. */
static size_t node_at(const perfect_table *t, int side, int turn, int tilt)
{
    return (size_t)((side * t->turns + turn) * TILTS + tilt);
}

vndf_vec3 perfect_table_direction(const perfect_table *t, size_t node)
{
    size_t tilt = node % TILTS, turn = node / TILTS % (size_t)t->turns;
    float side = node < node_at(t, 1, 0, 0) ? 1.0f : -1.0f;
    float angle = t->turns > 1 ? turn_at(t, (float)turn / (float)(t->turns - 1)) : 0.0f;
    return tilted(t, side, angle, (float)tilt / (TILTS - 1));
}

/* ---- filling ---- */

float perfect_table_knot(int i)
{
    float x = (float)i * (1.0f / CELLS), y = 1.0f - x;
    return x < 0.5f ? 2.0f * x * x : 1.0f - 2.0f * y * y;
}

static double width_of(size_t i)
{
    return (double)(perfect_table_knot((int)i + 1) - perfect_table_knot((int)i));
}

/* Sums over cells with the density `value`, each at least the least that counts, divided by their total. Returns
 * the mean of the densities. */
static double sum_up(const double value[CELLS], float sums[CELLS])
{
    double mean = 0, total = 0, below = 0;
    for (size_t i = 0; i < CELLS; i++)
        mean += width_of(i) * value[i];
    double least = mean > 0 ? (double)least_worth * mean : 1;
    for (size_t i = 0; i < CELLS; i++)
        total += width_of(i) * fmax(value[i], least);
    for (size_t i = 0; i < CELLS; i++) {
        below += width_of(i) * fmax(value[i], least);
        sums[i] = i + 1 < CELLS ? (float)(below / total) : 1.0f;
    }
    return mean;
}

void perfect_table_fill(perfect_table *t, size_t node, const float *worth, const float *share)
{
    float *sums = t->nodes + node * node_size(t);
    double rows[CELLS], row[CELLS];
    for (size_t i = 0; i < CELLS; i++) {
        for (size_t k = 0; k < CELLS; k++)
            row[k] = (double)worth[i * CELLS + k];
        rows[i] = sum_up(row, sums + CELLS + i * CELLS);
    }
    sum_up(rows, sums);
    if (t->lobes > 1)
        memcpy(sums + CELLS + CELLS * CELLS, share, CELLS * CELLS * sizeof *share);
}

/* ---- places ---- */

/* The node before a coordinate in [0, 1], and the rest of the coordinate. */
static int node_before(float at, int count, float *rest)
{
    float x = fminf(fmaxf(at, 0.0f), 1.0f) * (float)(count - 1);
    int before = (int)x < count - 2 ? (int)x : count - 2;
    *rest = x - (float)before;
    return before;
}

static void add_node(const perfect_table *t, perfect_place *place, size_t node, float weight)
{
    if (!(weight > 0.0f))
        return;
    place->node[place->count] = t->nodes + node * node_size(t);
    place->weight[place->count++] = weight;
}

static void add_turn(const perfect_table *t, perfect_place *place, int side, int turn, float tilt, float weight)
{
    float rest;
    int before = node_before(tilt, TILTS, &rest);
    add_node(t, place, node_at(t, side, turn, before), weight * (1.0f - rest));
    add_node(t, place, node_at(t, side, turn, before + 1), weight * rest);
}

void perfect_table_place(const perfect_table *t, vndf_vec3 wi, perfect_place *place)
{
    float tilt = tilt_of(t, wi), rest;
    int side = wi.z < 0.0f && t->sides > 1;
    place->count = 0;
    if (t->turns == 1) {
        add_turn(t, place, side, 0, tilt, 1.0f);
        return;
    }
    int before = node_before(turn_of(t, wi), t->turns, &rest);
    add_turn(t, place, side, before, tilt, 1.0f - rest);
    add_turn(t, place, side, before + 1, tilt, rest);
}

/* ---- drawing ---- */

static float part_of(const float *sums, size_t i)
{
    return i ? sums[i] - sums[i - 1] : sums[0];
}

/* The first cell whose sum is above *u; *u becomes the place in it. */
static size_t draw(const float sums[CELLS], float *u)
{
    size_t low = 0, high = CELLS - 1;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (sums[middle] > *u)
            high = middle;
        else
            low = middle + 1;
    }
    float rest = fminf((*u - (low ? sums[low - 1] : 0.0f)) / part_of(sums, low), 1.0f);
    float from = perfect_table_knot((int)low), to = perfect_table_knot((int)low + 1);
    *u = from + rest * (to - from);
    return low;
}

static perfect_cell cell_of(const perfect_table *t, const perfect_place *place, size_t row, size_t column)
{
    perfect_cell cell = {0.0f, 0.0f};
    size_t at = CELLS + row * CELLS;
    for (int i = 0; i < place->count; i++) {
        const float *node = place->node[i];
        cell.density += place->weight[i] * part_of(node, row) * part_of(node + at, column);
        cell.share += t->lobes > 1 ? place->weight[i] * node[at + CELLS * CELLS + column] : 0.0f;
    }
    cell.density /= (float)(width_of(row) * width_of(column));
    return cell;
}

perfect_cell perfect_table_draw(const perfect_table *t, const perfect_place *place, float u[3])
{
    int at = 0;
    for (; at + 1 < place->count && u[2] >= place->weight[at]; at++)
        u[2] -= place->weight[at];
    u[2] = fminf(u[2] / place->weight[at], 0.99999994f);
    size_t row = draw(place->node[at], &u[0]), column = draw(place->node[at] + CELLS + row * CELLS, &u[1]);
    return cell_of(t, place, row, column);
}

/* The cell that holds u. */
static size_t cell_with(float u)
{
    float x = u < 0.5f ? sqrtf(0.5f * u) : 1.0f - sqrtf(fmaxf(0.5f - 0.5f * u, 0.0f));
    return x < 1.0f ? (size_t)(x * CELLS) : CELLS - 1;
}

perfect_cell perfect_table_at(const perfect_table *t, const perfect_place *place, float u1, float u2)
{
    return cell_of(t, place, cell_with(u1), cell_with(u2));
}
