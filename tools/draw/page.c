#define _POSIX_C_SOURCE 200809L
#include "draw/page.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/arguments.h"
#include "cli/output.h"
#include "command.h"
#include "draw/chart.h"
#include "draw/svg.h"
#include "vndf.h"

/* ---- files --------------------------------------------------------------------------------------- */

static FILE *open_file(html_page *page, const char *name)
{
    page_file *file = &page->file[page->count];
    if (page->count == PAGE_FILES_MAX)
        return NULL;
    *file = (page_file){.text = NULL};
    snprintf(file->name, sizeof file->name, "%s", name);
    FILE *stream = open_memstream(&file->text, &file->size);
    page->count += stream != NULL;
    return stream;
}

static int close_file(FILE **stream)
{
    int good = *stream && !ferror(*stream);
    if (*stream && fclose(*stream) != 0)
        good = 0;
    *stream = NULL;
    return good;
}

FILE *page_file_begin(html_page *page, const char *name)
{
    page->data = open_file(page, name);
    return page->data;
}

int page_file_end(html_page *page)
{
    return close_file(&page->data);
}

int page_data_end(html_page *page, const char *what)
{
    const char *name = page->file[page->count - 1].name;
    fprintf(page->html, "<p class=\"note\">Data: <a href=\"%s\" download=\"%s\">%s</a>, %s.</p>\n", name, name,
            name, what);
    return page_file_end(page);
}

int page_data(html_page *page, const char *name, const char *what, text_table t)
{
    FILE *data = page_file_begin(page, name);
    int good = data && table_print(data, &t, FIGURES_CSV);
    table_free(&t);
    return good && page_data_end(page, what);
}

/* ---- the page ------------------------------------------------------------------------------------ */

/* Names the command near the beginning of a page. */
#define MARK "<meta name=\"generator\" content=\"%s\">"

static const char style[] =
    ":root{color-scheme:light dark;--back:#fff;--ink:#212529;--quiet:#495057;--rule:#dee2e6;"
    "--bad:#a94a00;--box:#f1f6fb;--link:#005f96}\n"
    "@media screen and (prefers-color-scheme:dark){:root{--back:#16191d;--ink:#e9ecef;--quiet:#b6bec6;"
    "--rule:#3a4149;--bad:#f4a06d;--box:#1d2731;--link:#7fbfec}}\n"
    "*{box-sizing:border-box}\n"
    "body{font:16px/1.5 'Helvetica Neue',Arial,'DejaVu Sans',sans-serif;color:var(--ink);background:var(--back);"
    "max-width:1180px;margin:0 auto;padding:24px}\n"
    "h1{font-size:1.7em;margin:0 0 .2em}h2{font-size:1.3em;margin:2.2em 0 .2em;padding-top:.6em;"
    "border-top:1px solid var(--rule)}h3{font-size:1.05em;margin:1.4em 0 .4em}\n"
    "p{margin:.4em 0}.lead,figcaption,.note{color:var(--quiet)}figcaption,.note{font-size:.9em}\n"
    "a{color:var(--link)}nav a{margin-right:1em;white-space:nowrap}\n"
    ".advice{background:var(--box);border-left:4px solid var(--link);padding:.6em 1em;margin:1em 0}\n"
    ".advice code{display:block;overflow-x:auto;white-space:pre}\n"
    ".scroll{overflow-x:auto}table{border-collapse:collapse;margin:.8em 0;font-variant-numeric:tabular-nums}\n"
    "th,td{padding:.25em .7em;text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}\n"
    ".text{text-align:left}th{font-weight:600;vertical-align:bottom;white-space:pre-line}\n"
    "tr.chosen td{font-weight:600;background:var(--box)}tr.chosen td:first-child::before{content:'✓ '}\n"
    ".no{color:var(--bad)}.no::after{content:' ✗'}\n"
    "figure{margin:1em 0;flex:1 1 480px;min-width:0;max-width:100%}figure svg{max-width:100%;height:auto}\n"
    ".panels{display:flex;flex-wrap:wrap;gap:0 8px;align-items:flex-start}\n"
    ".pair{display:flex;flex-wrap:wrap;gap:0 24px}\n"
    "@media screen{.wide svg.chart[role]{min-width:760px}}@media (max-width:600px){body{padding:12px}}\n"
    "@page{size:A4 landscape;margin:12mm}\n"
    "@media print{:root{color-scheme:light}body{font-size:10pt;max-width:none;padding:0}nav{display:none}\n"
    ".scroll{overflow:visible}h2{margin-top:1em}h2,h3,.lead{break-after:avoid}"
    "figure,table,.advice,.lead{break-inside:avoid}.panels{flex-wrap:nowrap}.panels svg{min-width:0;flex:0 1 auto}"
    ".wide svg[role]{max-height:145mm}"
    ".pair figure{flex:1 1 30%}a{color:inherit}}\n"
    "code{font-family:ui-monospace,'DejaVu Sans Mono',monospace;font-size:.92em;overflow-wrap:anywhere}\n";

int page_begin(html_page *page, const char *command, const char *title)
{
    *page = (html_page){.command = command};
    page->html = open_file(page, "index.html");
    if (!page->html)
        return 0;
    fprintf(page->html,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" MARK "\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
            command);
    svg_escape(page->html, title);
    fputs("</title>\n<style>\n", page->html);
    fputs(style, page->html);
    chart_style(page->html);
    fputs("</style>\n</head>\n<body>\n<h1>", page->html);
    svg_escape(page->html, title);
    fputs("</h1>\n", page->html);
    return 1;
}

int page_end(html_page *page)
{
    fprintf(page->html, "<p class=\"note\">Made by <code>%s</code>, vndf " VNDF_VERSION ".</p>\n", page->command);
    fputs("</body>\n</html>\n", page->html);
    return close_file(&page->html);
}

void page_free(html_page *page)
{
    close_file(&page->data);
    close_file(&page->html);
    for (size_t i = 0; i < page->count; i++) {
        free(page->file[i].text);
        free(page->file[i].path);
    }
    page->count = 0;
}

void page_section(html_page *page, const char *id, const char *title, const char *lead)
{
    fprintf(page->html, "<h2 id=\"%s\">", id);
    svg_escape(page->html, title);
    fputs("</h2>\n<p class=\"lead\">", page->html);
    svg_escape(page->html, lead);
    fputs("</p>\n", page->html);
}

/* ---- the folder ---------------------------------------------------------------------------------- */

static char *path_in(const char *folder, const char *name)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s", folder, name);
    return path;
}

static int has_our_page(const char *command, const char *folder)
{
    char head[1024 + 1] = "", mark[96];
    char *path = path_in(folder, "index.html");
    FILE *file = path ? fopen(path, "rb") : NULL;
    free(path);
    if (file) {
        head[fread(head, 1, 1024, file)] = '\0';
        fclose(file);
    }
    snprintf(mark, sizeof mark, MARK, command);
    return strstr(head, mark) != NULL;
}

page_place page_examine(const char *command, const char *path)
{
    if (output_is_stdout(path)) {
        complain(command, "'-' is stdout, and this needs a folder for its files; one of that name is './-'");
        return PAGE_REFUSED;
    }
    if (mkdir(path, 0777) == 0)
        return PAGE_NEW;
    if (errno != EEXIST) {
        complain(command, "cannot make the folder '%s': %s", path, strerror(errno));
        return PAGE_REFUSED;
    }
    DIR *directory = opendir(path);
    if (!directory) {
        complain(command, "'%s' is no folder that can be read: %s", path, strerror(errno));
        return PAGE_REFUSED;
    }
    int is_empty = 1;
    for (const struct dirent *entry; is_empty && (entry = readdir(directory)) != NULL;)
        is_empty = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0;
    closedir(directory);
    if (access(path, W_OK | X_OK) != 0)
        complain(command, "cannot write into '%s': %s", path, strerror(errno));
    else if (!is_empty && !has_our_page(command, path))
        complain(command,
                 "'%s' has files in it, and no page of `%s`: name a new folder, an empty one, or one with such a "
                 "page, which is replaced",
                 path, command);
    else
        return is_empty ? PAGE_EMPTY : PAGE_OURS;
    return PAGE_REFUSED;
}

/* The temporary of a file, with its text. An exit status. */
static int write_temporary(const html_page *page, page_file *file, const char *folder, output_file *output)
{
    free(file->path);
    file->path = path_in(folder, file->name);
    if (!file->path)
        return complain(page->command, "no memory");
    if (!output_open(output, page->command, file->path))
        return STATUS_USE;
    if (fwrite(file->text, 1, file->size, output->file) == file->size && fflush(output->file) == 0)
        return STATUS_GOOD;
    int reason = errno;
    output_give_up(output, NULL);
    return complain(page->command, "cannot write '%s': %s", file->name, strerror(reason));
}

int page_write(html_page *page, const char *folder)
{
    output_file output[PAGE_FILES_MAX];
    size_t count = 0, done = 0;
    int status = STATUS_GOOD;
    while (status == STATUS_GOOD && count < page->count) {
        page_file *file = &page->file[page->count - 1 - count]; /* the page, which is the first, last */
        status = write_temporary(page, file, folder, &output[count]);
        count += status == STATUS_GOOD;
    }
    if (status == STATUS_GOOD && output_stopping())
        status = complain(page->command, "interrupted; '%s' was not touched", folder);
    while (status == STATUS_GOOD && done < count)
        status = output_commit(&output[done++]);
    while (done < count)
        output_give_up(&output[done++], NULL);
    return status;
}
