#include "cli/figures.h"

#include <math.h>
#include <string.h>

#include "cli/output.h"
#include "command.h"

/* ---- figures, one after the other ---------------------------------------------------------------- */

figures figures_begin(const arguments *given)
{
    figures f = {.file = stdout, .form = FIGURES_TEXT};
    if (option_value(given, "-q"))
        f.form = FIGURES_NONE;
    else if (option_value(given, "--json"))
        f.form = FIGURES_JSON;
    return f;
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

static void note_unit(figures *f, const char *name, const char *unit)
{
    for (int i = 0; i < f->units; i++)
        if (f->unit[i].list == f->list && strcmp(f->unit[i].name, name) == 0)
            return;
    if (*unit && f->units < FIGURES_MAX)
        f->unit[f->units++] = (struct figures_unit){f->list, name, unit};
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
    if (f->form != FIGURES_JSON)
        return;
    fprintf(f->file, "%s\n  \"units\": {", f->in_object ? "," : "{");
    for (int i = 0; i < f->units; i++)
        fprintf(f->file, "%s\"%s%s%s\": \"%s\"", i ? ", " : "", f->unit[i].list ? f->unit[i].list : "",
                f->unit[i].list ? "." : "", f->unit[i].name, f->unit[i].unit);
    fputs("}\n}\n", f->file);
}

/* ---- rows ---------------------------------------------------------------------------------------- */

/* As figures_form and --format have them. */
static const char *const forms[] = {"text", "csv", "md", "json", NULL};

static figures_form form_of_stdout(const arguments *given)
{
    const char *path = option_value(given, "-o");
    if (option_value(given, "-q"))
        return FIGURES_NONE;
    if (option_value(given, "--json"))
        return FIGURES_JSON;
    return (figures_form)option_choice(given, "--format",
                                       path && output_is_stdout(path) ? FIGURES_CSV : FIGURES_TEXT);
}

int rows_check(const arguments *given)
{
    const char *path = option_value(given, "-o");
    output_file output;
    if (option_value(given, "--json") && option_value(given, "--format"))
        return complain(given->command, "--json and --format are given; --json is --format json"), 0;
    if (!path || output_is_stdout(path))
        return 1;
    if (output_form(given->command, path, NULL, forms + 1) < 0 || !output_open(&output, given->command, path))
        return 0;
    output_discard(&output);
    return 1;
}

static int print_to(const char *command, const char *path, rows_printer *print, const void *rows,
                    figures_form form)
{
    output_file output;
    if (!output_open(&output, command, path))
        return STATUS_USE;
    return print(output.file, rows, form) ? output_commit(&output)
                                          : output_give_up(&output, "no memory for the table");
}

int rows_print(const arguments *given, rows_printer *print, const void *rows)
{
    const char *command = given->command, *path = option_value(given, "-o");
    const figures_form form = form_of_stdout(given);
    int to_file = STATUS_GOOD;
    int status = form == FIGURES_NONE ? STATUS_GOOD : print_to(command, "-", print, rows, form);
    if (path && !output_is_stdout(path))
        to_file =
            print_to(command, path, print, rows, (figures_form)(1 + output_form(command, path, NULL, forms + 1)));
    return status == STATUS_GOOD ? to_file : status;
}
