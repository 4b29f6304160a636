/* Tables of the alias method, in linear time (Vose, "A Linear Algorithm for Generating Random Numbers with a Given
 * Distribution", IEEE TSE 1991): pairs each place that has too little with one that has too much. */
#include "render/path/alias.h"

#include <math.h>
#include <stdlib.h>

/* A part of 2^32: at least 1 unless the weight is 0. */
static uint32_t part_of(double part)
{
    return (uint32_t)fmin(ceil(part * 0x1p32), 4294967295.0);
}

/* Puts the places that have too little at the front of `order`, the others at its back; returns the number of the
 * first. */
static uint32_t sort_places(const double *part, uint32_t count, uint32_t *order)
{
    uint32_t poor = 0, rich = count;
    for (uint32_t i = 0; i < count; i++)
        if (part[i] < 1)
            order[poor++] = i;
        else
            order[--rich] = i;
    return poor;
}

/* Each poor place takes from the rich place at hand, which may become poor itself. Places that rounding leaves
 * over keep all of their own. */
static void pair_places(alias_place *table, double *part, uint32_t count, uint32_t *order)
{
    uint32_t next = 0, poor = sort_places(part, count, order);
    for (; next < poor && poor < count; next++) {
        uint32_t at = order[next], giver = order[poor];
        table[at].keep = part_of(part[at]);
        table[at].other = giver;
        part[giver] -= 1 - part[at];
        poor += part[giver] < 1;
    }
    for (; next < count; next++) {
        table[order[next]].keep = UINT32_MAX;
        table[order[next]].other = order[next];
    }
}

alias_place *alias_make(const double *weights, uint32_t count)
{
    alias_place *table = malloc(count * sizeof *table);
    double *part = malloc(count * sizeof *part), sum = 0;
    uint32_t *order = malloc(count * sizeof *order);
    int good = table && part && order;
    for (uint32_t i = 0; i < count; i++)
        sum += weights[i];
    for (uint32_t i = 0; good && i < count; i++) {
        part[i] = weights[i] / sum * count;
        table[i].own = (float)(weights[i] / sum);
    }
    if (good)
        pair_places(table, part, count, order);
    for (uint32_t i = 0; good && i < count; i++)
        table[i].others = table[table[i].other].own;
    free(part);
    free(order);
    if (good)
        return table;
    free(table);
    return NULL;
}
