/* A table is printed as it was filled: text in groups with columns as wide as they have to be, Markdown, CSV and
 * a page with what would end a cell escaped; what is NaN is a dash, in CSV nothing. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>

#include "draw/table.h"
#include "harness/test.h"

static void add_row(text_table *t, const char *group, const char *name, double x, double y)
{
    table_row(t);
    table_text(t, "group", group);
    table_text(t, "name", name);
    table_word(t, "set", "avx2");
    table_number(t, "x: first", "%.1f", x);
    table_mark(t, x > 5 ? "no" : NULL);
    table_value(t, "y", y);
}

static text_table example(void)
{
    text_table t = {.rows = 0};
    add_row(&t, "a", "short", 1.25, (double)NAN);
    add_row(&t, "a", "a | \"b\" & c", 10, 3);
    add_row(&t, "bé", "last", (double)NAN, 1e-7);
    return t;
}

/* What `print` writes of the table is `want`. */
static void check(const text_table *t, int (*print)(FILE *, const text_table *), const char *want)
{
    char got[1024] = "";
    FILE *file = tmpfile();
    if (!TEST(file != NULL))
        return;
    TEST(print(file, t));
    rewind(file);
    got[fread(got, 1, sizeof got - 1, file)] = '\0';
    fclose(file);
    if (!TEST(strcmp(got, want) == 0))
        fprintf(stderr, "got\n%swant\n%s", got, want);
}

static void test_printers(const text_table *t)
{
    check(t, table_print_text,
          "a              set   x: first      y\n"
          "  short        avx2       1.2      -\n"
          "  a | \"b\" & c  avx2      10.0      3\n"
          "\n"
          "bé             set   x: first      y\n"
          "  last         avx2         -  1e-07\n");
    check(t, table_print_markdown,
          "| group | name | set | x: first | y |\n"
          "|---|---|---|--:|--:|\n"
          "| a | short | avx2 | 1.2 | - |\n"
          "| a | a \\| \"b\" & c | avx2 | 10.0 | 3 |\n"
          "| bé | last | avx2 | - | 1e-07 |\n");
    check(t, table_print_csv,
          "group,name,set,x: first,y\n"
          "\"a\",\"short\",avx2,1.2,\n"
          "\"a\",\"a | \"\"b\"\" & c\",avx2,10.0,3\n"
          "\"bé\",\"last\",avx2,,1e-07\n");
    check(
        t, table_print_html,
        "<div class=\"scroll\"><table><thead><tr><th>group</th><th>name</th><th>set</th><th>x: first</th>"
        "<th>y</th></tr></thead>\n<tbody>\n"
        "<tr><td>a</td><td>short</td><td>avx2</td><td>1.2</td><td>-</td></tr>\n"
        "<tr><td>a</td><td>a | &quot;b&quot; &amp; c</td><td>avx2</td><td class=\"no\">10.0</td><td>3</td></tr>\n"
        "<tr><td>bé</td><td>last</td><td>avx2</td><td>-</td><td>1e-07</td></tr>\n"
        "</tbody></table></div>\n");
}

static void test_many_rows(void)
{
    text_table t = {.rows = 0};
    for (int i = 0; i < 1000; i++)
        add_row(&t, "a", "b", i, i);
    TEST(!t.failed && t.rows == 1000 && t.count == 5000 && t.columns == 5);
    TEST(strcmp(t.cell[4999].text, "999") == 0);
    table_free(&t);
    TEST(t.rows == 0 && t.cell == NULL);
}

static void test_bytes(void)
{
    static const struct {
        double bytes;
        const char *name;
    } sizes[] = {{2040, "2 KiB"}, {26404, "25.8 KiB"}, {1048000, "1 MiB"}, {2048, "2 KiB"}, {3000, "2.93 KiB"}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char text[TABLE_BYTES];
        table_bytes_text(text, sizes[i].bytes);
        TEST(strcmp(text, sizes[i].name) == 0);
    }
}

int main(void)
{
    text_table t = example();
    test_printers(&t);
    table_free(&t);
    test_many_rows();
    test_bytes();
    return test_done();
}
