/* A page in a folder: a head with its style, sections with a title, and the data behind each plot in a file beside
 * the page. Memory holds all of it until the files are written together. */
#ifndef TOOLS_DRAW_PAGE_H
#define TOOLS_DRAW_PAGE_H

#include <stddef.h>
#include <stdio.h>

#include "draw/table.h"

enum { PAGE_FILES_MAX = 64, PAGE_NAME_MAX = 64 };

typedef struct page_file {
    char name[PAGE_NAME_MAX];
    char *text, *path; /* owned; path: where it is being written */
    size_t size;
} page_file;

typedef struct html_page {
    const char *command;            /* makes the page */
    FILE *html;                     /* the page goes here */
    page_file file[PAGE_FILES_MAX]; /* the first is the page itself */
    size_t count;
    FILE *data; /* open between page_file_begin and its end */
} html_page;

/* Returns 0 if there is no memory; call page_free in any case. */
int page_begin(html_page *page, const char *command, const char *title);
int page_end(html_page *page);
void page_free(html_page *page);

/* A heading with a line or two below it; both are plain text. */
void page_section(html_page *page, const char *id, const char *title, const char *lead);

/* Begins a new file beside the page, for the caller to fill; NULL if there is no memory. */
FILE *page_file_begin(html_page *page, const char *name);
int page_file_end(html_page *page);

/* Ends the file; the page links it. */
int page_data_end(html_page *page, const char *what);

/* A table as a whole file of data; it is freed. 0 if there is no memory. */
int page_data(html_page *page, const char *name, const char *what, text_table t);

/* ---- folders ---- */

/* A folder is made if it does not exist; if it does, it has to be empty or hold a page of the same command,
 * whose files are replaced, and nothing else is touched. Complains if it is refused. */
typedef enum page_place { PAGE_REFUSED, PAGE_NEW, PAGE_EMPTY, PAGE_OURS } page_place;
page_place page_examine(const char *command, const char *folder);

/* All files are written to temporaries first and renamed when all are complete, the page last; a failure or a
 * signal before that leaves the folder as it was. An exit status, after a complaint if it is not good. */
int page_write(html_page *page, const char *folder);

#endif
