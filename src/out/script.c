/* script.c -- see script.h */
#include "out/script.h"

#include <string.h>

#include "base/text.h"
#include "out/cell.h"

void script_put_text(FILE *to, const char *text)
{
    const char *end = text + strlen(text);
    fputc('\'', to);
    for (size_t n; text < end; text += n) {
        char shown[16];
        int columns;
        n = text_shown(shown, &columns, text, end);
        if (*text == '\'') fputc('\'', to);
        fputs(shown, to);
    }
    fputc('\'', to);
}

void script_put_number(FILE *to, double x)
{
    char number[NUMBER_MOST + 1];
    *cell_put(number, x, "?") = 0;
    fputs(number, to);
}

const char *script_color(int i)
{
    static const char *const colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                         "#e69f00", "#56b4e9", "#7b3294", "#000000"};
    return colors[i % 8];
}
