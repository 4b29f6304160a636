/* Distributions of a scene: closed forms, tables that are loaded, and tables that are built in memory. Materials
 * with the same distribution share it; its key is the kind, the size and the text. */
#include "render/scene/reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "vndf_build.h"

enum { FORM_GGX, FORM_BECKMANN, FORM_TABLE, FORM_FAMILY, FORM_SLOPE, FORM_NDF, FORMS };
static const char *const forms[FORMS] = {"ggx", "beckmann", "table", "family", "slope", "ndf"};

static vndf_source *source_of(unsigned form, const char *text, vndf_error *error)
{
    if (form == FORM_FAMILY)
        return vndf_source_family(text, error);
    return form == FORM_SLOPE ? vndf_source_slope_expression(text, NULL, 0, error)
                              : vndf_source_ndf_expression(text, NULL, 0, error);
}

static vndf_distribution *build(unsigned form, const char *text, unsigned bytes, vndf_error *error)
{
    const vndf_build_options options = {.max_bytes = bytes};
    vndf_source *source = source_of(form, text, error);
    vndf_distribution *built = source ? vndf_build(source, &options, NULL, error) : NULL;
    vndf_source_free(source);
    return built;
}

static vndf_distribution *load(scene_reader *r, const word *at, vndf_error *error)
{
    char *path = reader_path(r, at);
    vndf_distribution *loaded = path ? vndf_load(path, error) : NULL;
    if (!path)
        error->message[0] = '\0'; /* reader_refuse has written the message */
    free(path);
    return loaded;
}

static int add_table(scene_reader *r, const word *at, char *key, vndf_distribution *table)
{
    scene *s = r->made;
    if (!s->tables)
        s->tables = calloc(SCENE_TABLES_MAX, sizeof *s->tables);
    if (!s->table_names)
        s->table_names = calloc(SCENE_TABLES_MAX, sizeof *s->table_names);
    if (!s->tables || !s->table_names || s->table_count == SCENE_TABLES_MAX) {
        vndf_free(table);
        free(key);
        return reader_refuse(r, at,
                             s->table_count == SCENE_TABLES_MAX ? "these are more than %d tables"
                                                                : "there is no memory for %d tables",
                             SCENE_TABLES_MAX);
    }
    s->table_names[s->table_count] = key;
    s->tables[s->table_count++] = table;
    return 1;
}

static char *key_of(scene_reader *r, unsigned form, const word *text, unsigned bytes)
{
    size_t size = strlen(text->text) + 64;
    char *key = malloc(size);
    if (!key)
        reader_refuse(r, text, "there is no memory for this distribution");
    else if (form == FORM_TABLE)
        snprintf(key, size, "table %s", text->text);
    else
        snprintf(key, size, "%s %s, %u bytes", forms[form], text->text, bytes);
    return key;
}

static int table_of(scene_reader *r, unsigned form, const word *text, unsigned bytes,
                    const vndf_distribution **found)
{
    vndf_error error = {VNDF_OK, ""};
    const scene *s = r->made;
    char *key = key_of(r, form, text, bytes);
    if (!key)
        return 0;
    for (size_t i = 0; i < s->table_count; i++)
        if (strcmp(s->table_names[i], key) == 0) {
            free(key);
            *found = s->tables[i];
            return 1;
        }
    vndf_distribution *table = form == FORM_TABLE ? load(r, text, &error) : build(form, text->text, bytes, &error);
    *found = table;
    if (table)
        return add_table(r, text, key, table);
    free(key);
    return error.message[0] ? reader_refuse(r, text, "%s", error.message) : 0;
}

int read_distribution(scene_reader *r, const clause *c, unsigned bytes, const vndf_distribution **found)
{
    unsigned form;
    if (!reader_choice(r, c, forms, FORMS, &form))
        return 0;
    if (r->tables.bytes)
        bytes = r->tables.bytes;
    if (form == FORM_GGX || form == FORM_BECKMANN) {
        if (c->count > 1)
            return reader_refuse(r, &c->values[1], "'distribution %s' takes nothing more", forms[form]);
        *found = form == FORM_GGX ? vndf_ggx() : vndf_beckmann();
        return !r->tables.closed_forms || table_of(r, FORM_FAMILY, &c->values[0], bytes, found);
    }
    if (c->count < 2)
        return reader_refuse(r, &c->values[0], "'distribution %s' needs %s", forms[form],
                             form == FORM_TABLE    ? "a file"
                             : form == FORM_FAMILY ? "a family, as in student-t:2.5"
                                                   : "a formula between quotes");
    return table_of(r, form, &c->values[1], bytes, found);
}
