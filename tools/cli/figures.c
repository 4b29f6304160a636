#include "cli/figures.h"

#include <math.h>
#include <string.h>

figures figures_begin(const arguments *given)
{
    return (figures){.file = stdout,
                     .form = option_value(given, "-q")       ? FIGURES_NONE
                             : option_value(given, "--json") ? FIGURES_JSON
                                                             : FIGURES_TEXT};
}

void figures_json_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        unsigned char letter = (unsigned char)*text;
        if (letter < 0x20)
            fprintf(file, "\\u%04x", letter);
        else if (letter == '"' || letter == '\\')
            fprintf(file, "\\%c", letter);
        else
            fputc(letter, file);
    }
    fputc('"', file);
}

enum { COLUMNS = 100 }; /* of a record; what is longer goes on below */

/* Units stand at the end of JSON, each once, as "list.name": "unit". */
static void note_unit(figures *f, const char *name, const char *unit)
{
    char text[128];
    const size_t used = strlen(f->units);
    snprintf(text, sizeof text, "\"%s%s%s\": \"%s\"", f->list ? f->list : "", f->list ? "." : "", name, unit);
    if (*unit && !strstr(f->units, text))
        snprintf(f->units + used, sizeof f->units - used, "%s%s", used ? ", " : "", text);
}

/* A figure whose value is this text. */
static void put(figures *f, const char *name, const char *text, int is_word, const char *unit)
{
    const int is_first = f->in_object++ == 0;
    if (f->form == FIGURES_TEXT) {
        char whole[COLUMNS];
        int length = snprintf(whole, sizeof whole, " %s %s%s%s", name, text, *unit ? " " : "", unit);
        if (f->list && f->column + length > COLUMNS) {
            fputs("\n   ", f->file);
            f->column = 3;
        }
        f->column += length;
        fprintf(f->file, f->list ? " %s %s%s%s" : "%s %s%s%s\n", name, text, *unit ? " " : "", unit);
    } else if (f->form == FIGURES_JSON) {
        fprintf(f->file, "%s%s\"%s\": ", is_first ? f->list ? "" : "{" : ",",
                f->list ? is_first ? "" : " " : "\n  ", name);
        if (is_word)
            figures_json_text(f->file, text);
        else
            fputs(text, f->file);
        note_unit(f, name, unit);
    }
}

void figures_text(figures *f, const char *name, const char *text)
{
    put(f, name, text, 1, "");
}

void figures_number(figures *f, const char *name, int digits, double x, const char *unit)
{
    char text[64];
    snprintf(text, sizeof text, f->form == FIGURES_JSON && !isfinite(x) ? "null" : "%.*g", digits, x);
    put(f, name, text, 0, unit);
}

void figures_truth(figures *f, const char *name, int is)
{
    static const char *const said[2][2] = {{"no", "yes"}, {"false", "true"}};
    put(f, name, said[f->form == FIGURES_JSON][is != 0], 0, "");
}

void figures_list(figures *f, const char *name)
{
    if (f->form == FIGURES_JSON)
        put(f, name, "[", 0, "");
    f->list = name;
    f->records = 0;
}

static void end_record(figures *f)
{
    if (f->records && f->form == FIGURES_JSON)
        fputc('}', f->file);
    else if (f->records && f->form == FIGURES_TEXT)
        fputc('\n', f->file);
}

void figures_record(figures *f)
{
    end_record(f);
    if (f->form == FIGURES_JSON)
        fputs(f->records ? ",\n    {" : "\n    {", f->file);
    else if (f->form == FIGURES_TEXT)
        f->column = fprintf(f->file, "%s", f->list);
    f->records++;
    f->in_object = 0;
}

void figures_list_end(figures *f)
{
    end_record(f);
    if (f->form == FIGURES_JSON)
        fputs(f->records ? "\n  ]" : "]", f->file);
    f->list = NULL;
    f->in_object = 1;
}

void figures_end(figures *f)
{
    if (f->form == FIGURES_JSON)
        fprintf(f->file, "%s\n  \"units\": {%s}\n}\n", f->in_object ? "," : "{", f->units);
}
