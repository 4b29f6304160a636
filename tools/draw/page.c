#define _POSIX_C_SOURCE 200809L
#include "draw/page.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "command.h"
#include "draw/draw.h"
#include "vndf.h"

#define MARK "<meta name=\"generator\" content=\"%s\">"

static int has_our_page(const html_page *page)
{
    char head[1024 + 1] = "", mark[96], path[4096];
    snprintf(path, sizeof path, "%s/index.html", page->folder);
    snprintf(mark, sizeof mark, MARK, page->command);
    FILE *file = fopen(path, "rb");
    if (file) {
        head[fread(head, 1, 1024, file)] = '\0';
        fclose(file);
    }
    return strstr(head, mark) != NULL;
}

static int may_fill(html_page *page)
{
    const char *command = page->command, *path = page->folder;
    DIR *directory = opendir(path);
    if (!directory)
        return denied(command, "'%s' is no folder that can be read: %s", path, strerror(errno));
    for (const struct dirent *entry; !page->is_replaced && (entry = readdir(directory)) != NULL;)
        page->is_replaced = strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    if (access(path, W_OK | X_OK) != 0)
        return denied(command, "cannot write into '%s': %s", path, strerror(errno));
    return !page->is_replaced || has_our_page(page) ||
           denied(command, "'%s' has files in it, and no page of `%s`: name a new or an empty folder", path,
                  command);
}

int page_open(html_page *page, const char *command, const char *folder)
{
    *page = (html_page){.command = command, .folder = folder};
    output_hold_signals();
    if (output_is_stdout(folder))
        complain(command, "'-' is stdout, and this needs a folder for its files; one of that name is './-'");
    else if (mkdir(folder, 0777) == 0)
        return page->is_new = 1;
    else if (errno != EEXIST)
        complain(command, "cannot make the folder '%s': %s", folder, strerror(errno));
    else if (may_fill(page))
        return 1;
    output_release_signals();
    return 0;
}

int page_close(html_page *page, int status)
{
    if (status == STATUS_GOOD && output_stopping())
        status = complain(page->command, "interrupted; '%s' was not touched", page->folder);
    status = output_commit_all(page->file, page->count, status);
    for (size_t i = 0; i < page->count; i++)
        free(page->path[i]);
    if (status != STATUS_GOOD && page->is_new)
        rmdir(page->folder); /* fails, and the folder stays, if a file was committed */
    output_release_signals();
    return status;
}

FILE *page_file(html_page *page, const char *name)
{
    const size_t n = page->count, size = strlen(page->folder) + strlen(name) + 2;
    char *path = n < PAGE_FILES_MAX ? malloc(size) : NULL;
    if (!path)
        return complain(page->command, "no memory"), NULL;
    snprintf(path, size, "%s/%s", page->folder, name);
    snprintf(page->name[n], sizeof page->name[n], "%s", name);
    page->path[n] = path;
    if (output_open(&page->file[n], page->command, path))
        return page->file[page->count++].file;
    free(path);
    return NULL;
}

void page_link(html_page *page, const char *what)
{
    const char *name = page->name[page->count - 1];
    fprintf(page->html, "<p class=\"note\">Data: <a href=\"%s\" download=\"%s\">%s</a>, %s.</p>\n", name, name,
            name, what);
}

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
    ".group th{white-space:normal;overflow-wrap:anywhere;padding-top:1em}\n"
    ".no{color:var(--bad)}.no::after{content:' ✗'}\n"
    "figure{margin:1em 0;min-width:0;max-width:100%}figure svg{max-width:100%;height:auto}\n"
    ".panels{display:flex;flex-wrap:wrap;gap:0 8px;align-items:flex-start}\n"
    "@media screen{.wide svg.chart[role]{min-width:760px}}@media (max-width:600px){body{padding:12px}}\n"
    "code{font-family:ui-monospace,'DejaVu Sans Mono',monospace;font-size:.92em;overflow-wrap:anywhere}\n";

int page_begin(html_page *page, const char *title)
{
    page->html = page_file(page, "index.html");
    if (!page->html)
        return 0;
    fprintf(page->html,
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n" MARK "\n"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
            page->command);
    svg_escape(page->html, title);
    fprintf(page->html, "</title>\n<style>\n%s", style);
    svg_style(page->html);
    fputs("</style>\n</head>\n<body>\n<h1>", page->html);
    svg_escape(page->html, title);
    fputs("</h1>\n", page->html);
    return 1;
}

void page_end(html_page *page)
{
    fprintf(page->html,
            "<p class=\"note\">Made by <code>%s</code>, vndf " VNDF_VERSION ".</p>\n</body>\n</html>\n",
            page->command);
}

void page_section(html_page *page, const char *id, const char *title, const char *lead)
{
    fprintf(page->html, "<h2 id=\"%s\">", id);
    svg_escape(page->html, title);
    fputs("</h2>\n<p class=\"lead\">", page->html);
    svg_escape(page->html, lead);
    fputs("</p>\n", page->html);
}

static void put_cell(FILE *html, const char *tag, const char *mark, const char *text)
{
    fprintf(html, mark ? "<%s class=\"%s\">" : "<%s>", tag, mark);
    svg_escape(html, text);
    fprintf(html, "</%s>", tag);
}

int page_table(html_page *page, const figures *f)
{
    FILE *html = page->html;
    const size_t columns = figures_columns(f);
    if (f->failed)
        return denied(page->command, "no memory");
    fputs("<div class=\"scroll\"><table><thead><tr>", html);
    for (size_t k = 1; k < columns; k++)
        put_cell(html, "th", f->at[k].kind == FIGURE_NUMBER ? NULL : "text", f->at[k].name);
    fputs("</tr></thead>\n<tbody>\n", html);
    for (size_t i = 0; i < f->rows; i++) {
        const figure *row = f->at + i * columns;
        if (i == 0 || strcmp(row->text, row[-(ptrdiff_t)columns].text) != 0) {
            fprintf(html, "<tr class=\"group\"><th class=\"text\" colspan=\"%zu\">", columns - 1);
            svg_escape(html, row->text);
            fputs("</th></tr>\n", html);
        }
        fprintf(html, row->mark ? "<tr class=\"%s\">" : "<tr>", row->mark);
        for (size_t k = 1; k < columns; k++)
            put_cell(html, "td", row[k].kind == FIGURE_NUMBER ? row[k].mark : "text", figures_shown(f, i, k));
        fputs("</tr>\n", html);
    }
    fputs("</tbody></table></div>\n", html);
    return 1;
}
