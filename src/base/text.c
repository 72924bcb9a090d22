/* text.c -- see text.h */
#include "base/text.h"

#include <string.h>
#include <strings.h>

enum { LONGEST = 63 };

static int least(int a, int b)
{
    return a < b ? a : b;
}

int text_distance(const char *a, const char *b)
{
    int la = (int)strnlen(a, LONGEST + 1), lb = (int)strnlen(b, LONGEST + 1);
    if (la > LONGEST || lb > LONGEST) return 2 * LONGEST;
    int d[LONGEST + 1][LONGEST + 1]; /* d[i][j]: distance of the first i and the first j letters */
    for (int i = 0; i <= la; i++) d[i][0] = i;
    for (int j = 0; j <= lb; j++) d[0][j] = j;
    for (int i = 1; i <= la; i++) {
        for (int j = 1; j <= lb; j++) {
            int change = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            d[i][j] = least(change, 1 + least(d[i - 1][j], d[i][j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = least(d[i][j], 1 + d[i - 2][j - 2]);
        }
    }
    return d[la][lb];
}

const char *text_nearest(const char *word, const char *const *words, int n)
{
    const char *nearest = NULL;
    int best = 2 + (int)strlen(word) / 4;
    for (int i = 0; i < n; i++) {
        int distance = strcasecmp(word, words[i]) ? text_distance(word, words[i]) : 0;
        if (distance < best) {
            best = distance;
            nearest = words[i];
        }
    }
    return nearest;
}

bool text_match(const char *pattern, const char *name)
{
    const char *star = NULL, *from = NULL; /* the last '*' and where its run starts in name */
    while (*name) {
        if (*pattern == '*') {
            star = ++pattern;
            from = name;
        } else if (*pattern == '?' || *pattern == *name) {
            pattern++;
            name++;
        } else if (star) {
            pattern = star;
            name = ++from;
        } else {
            return false;
        }
    }
    while (*pattern == '*') pattern++;
    return *pattern == 0;
}

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool text_is_name(const char *text)
{
    if (!is_letter(*text)) return false;
    while (is_letter(*text) || (*text >= '0' && *text <= '9') || *text == '_') text++;
    return *text == 0;
}
