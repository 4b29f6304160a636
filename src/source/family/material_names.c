/* Finds materials by name and by index, and suggests names for a misspelt one. */
#include <string.h>

#include "source/family/materials.h"
#include "vndf_build.h"

enum { LONGEST = 64, SHOWN = 3 };

const vndf_material *vndf_material_find(const char *name, size_t size)
{
    for (size_t i = 0; i < VNDF_MATERIAL_COUNT; i++)
        if (strlen(vndf_materials[i].name) == size && memcmp(vndf_materials[i].name, name, size) == 0)
            return &vndf_materials[i];
    return NULL;
}

const char *vndf_family_material(size_t index)
{
    return index < VNDF_MATERIAL_COUNT ? vndf_materials[index].name : NULL;
}

/* Letters to insert, drop or replace to turn a (at most LONGEST letters) into b, row by row. */
static size_t edit_distance(const char *a, size_t size, const char *b)
{
    size_t row[LONGEST + 1];
    for (size_t i = 0; i <= size; i++)
        row[i] = i;
    for (; *b; b++) {
        size_t diagonal = row[0]++;
        for (size_t i = 1; i <= size; i++) {
            size_t replaced = diagonal + (a[i - 1] != *b);
            size_t inserted = (row[i] < row[i - 1] ? row[i] : row[i - 1]) + 1;
            diagonal = row[i];
            row[i] = replaced < inserted ? replaced : inserted;
        }
    }
    return row[size];
}

/* Puts a material into the list of the nearest, kept in ascending order of distance. */
static void insert_nearest(size_t distance, size_t material, size_t distances[SHOWN], size_t nearest[SHOWN])
{
    size_t at = SHOWN;
    while (at > 0 && distance < distances[at - 1])
        at--;
    for (size_t i = SHOWN - 1; i > at; i--) {
        distances[i] = distances[i - 1];
        nearest[i] = nearest[i - 1];
    }
    if (at < SHOWN) {
        distances[at] = distance;
        nearest[at] = material;
    }
}

const char *vndf_material_nearest(char out[VNDF_MATERIAL_NEAREST], const char *name, size_t size)
{
    size_t distances[SHOWN] = {(size_t)-1, (size_t)-1, (size_t)-1}, nearest[SHOWN] = {0, 0, 0};
    size = size < LONGEST ? size : LONGEST;
    for (size_t i = 0; i < VNDF_MATERIAL_COUNT; i++)
        insert_nearest(edit_distance(name, size, vndf_materials[i].name), i, distances, nearest);
    out[0] = '\0';
    for (size_t i = 0; i < SHOWN; i++) {
        strncat(out, i > 0 ? ", " : "", VNDF_MATERIAL_NEAREST - 1 - strlen(out));
        strncat(out, vndf_materials[nearest[i]].name, VNDF_MATERIAL_NEAREST - 1 - strlen(out));
    }
    return out;
}
