#include "cli/figures.h"

#include <math.h>
#include <string.h>

#include "cli/output.h"
#include "command.h"

/* ---- figures, one after the other ---------------------------------------------------------------- */

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

/* ---- rows ---------------------------------------------------------------------------------------- */

/* As figures_form and --format have them. */
static const char *const forms[] = {"text", "csv", "md", "json", NULL};

int rows_check(const arguments *given)
{
    const char *path = option_value(given, "-o");
    output_file output;
    if (option_value(given, "--json") && option_value(given, "--format"))
        return complain(given->command, "--json and --format are given; --json is --format json"), 0;
    if (!path || output_is_stdout(path))
        return 1;
    if (output_form(given->command, path, forms + 1) < 0 || !output_open(&output, given->command, path))
        return 0;
    output_give_up(&output, NULL);
    return 1;
}

static int print_to(const arguments *given, const char *path, rows_printer *print, const void *rows, int form)
{
    output_file output;
    if (!output_open(&output, given->command, path))
        return STATUS_USE;
    return print(output.file, rows, (figures_form)form) ? output_commit(&output)
                                                        : output_give_up(&output, "no memory for the table");
}

int rows_print(const arguments *given, rows_printer *print, const void *rows)
{
    const char *path = option_value(given, "-o");
    const int has_file = path && !output_is_stdout(path);
    int form = (int)figures_begin(given).form, status = STATUS_GOOD;
    if (form == FIGURES_TEXT)
        form = option_choice(given, "--format", path && !has_file ? FIGURES_CSV : FIGURES_TEXT);
    if (form != FIGURES_NONE)
        status = print_to(given, "-", print, rows, (int)form);
    int to_file = has_file ? print_to(given, path, print, rows, 1 + output_form(given->command, path, forms + 1))
                           : STATUS_GOOD;
    return status == STATUS_GOOD ? to_file : status;
}
