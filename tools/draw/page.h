/* A page in a folder: a head with its style, sections with a title, and the data behind each plot in a file beside
 * the page. All of them are temporaries until page_close renames them together, the page last; a failure or a signal
 * before that leaves the folder as it was. */
#pragma once

#include "cli/figures.h"
#include "cli/output.h"

enum { PAGE_FILES_MAX = 128, PAGE_NAME_MAX = 64 };

typedef struct html_page {
    const char *command, *folder;             /* what makes the page, and where */
    int is_new, is_replaced;                  /* the folder was made for it; it held a page of the same command */
    FILE *html;                               /* the page goes here */
    char name[PAGE_FILES_MAX][PAGE_NAME_MAX]; /* of the files; the first is the page itself */
    char *path[PAGE_FILES_MAX];               /* owned */
    output_file file[PAGE_FILES_MAX];
    size_t count;
} html_page;

/* Before anything is measured. The folder is made if it does not exist; if it does, it has to be empty or hold a page
 * of the same command, whose files are replaced, and nothing else is touched. 0 after a complaint. Signals wait from
 * here to page_close. */
int page_open(html_page *page, const char *command, const char *folder);

/* If `status` is good all files appear, else none, and a folder that was made for them goes. An exit status, after a
 * complaint if that is what changes it. */
int page_close(html_page *page, int status);

/* The head of the page, and its foot. 0 after a complaint. */
int page_begin(html_page *page, const char *title);
void page_end(html_page *page);

/* A heading with a line or two below it; both are plain text. */
void page_section(html_page *page, const char *id, const char *title, const char *lead);

/* A table, in groups of rows under what the first column says of them; 0 after a complaint. */
int page_table(html_page *page, const figures *f);

/* Begins a new file beside the page, for the caller to fill; NULL after a complaint. */
FILE *page_file(html_page *page, const char *name);

/* The page links the file that was begun last. */
void page_link(html_page *page, const char *what);
