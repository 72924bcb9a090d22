/* completion.c -- completion of the shell, from the tables of verbs and options: fmdsub list completion bash|zsh|fish */
#include <string.h>

#include "cli/cli.h"
#include "cli/page.h"

/* Between single quotes: what stands for a quote there. */
static void put_quoted(FILE *to, const char *text, const char *quote)
{
    for (; *text; text++)
        if (*text == '\'')
            fputs(quote, to);
        else
            putc(*text, to);
}

/* Words to choose from, "a|b"; false: the value is free, or stands for one, as in capitals. */
static bool has_choices(const struct cli_option *o)
{
    return o->value && strchr(o->value, '|') && strspn(o->value, "abcdefghijklmnopqrstuvwxyz|") == strlen(o->value);
}

static void put_words(FILE *to, const char *words)
{
    for (; *words; words++) putc(*words == '|' ? ' ' : *words, to);
}

static void put_options(FILE *to, const char *verb)
{
    for (const struct cli_option *o = cli_options; o->name; o++) {
        if (!cli_serves(o, verb)) continue;
        fprintf(to, " --%s", o->name);
        if (o->letter) fprintf(to, " -%c", o->letter);
    }
}

static void print_bash(FILE *to)
{
    fputs("# completion of fmdsub for bash\n_fmdsub()\n{\n    local cur=${COMP_WORDS[COMP_CWORD]} prev= verb= word\n"
          "    ((COMP_CWORD > 0)) && prev=${COMP_WORDS[COMP_CWORD - 1]}\n"
          "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n        case $word in",
          to);
    for (const struct verb *v = verbs; v->name; v++) fprintf(to, "%s%s", v == verbs ? " " : "|", v->name);
    fputs(") verb=$word; break ;; esac\n    done\n    COMPREPLY=()\n    case $prev in\n", to);
    for (const struct cli_option *o = cli_options; o->name; o++) {
        if (!has_choices(o)) continue;
        fprintf(to, "    --%s", o->name);
        if (o->letter) fprintf(to, "|-%c", o->letter);
        fputs(") COMPREPLY=($(compgen -W '", to);
        put_words(to, o->value);
        fputs("' -- \"$cur\")); return ;;\n", to);
    }
    fputs("    esac\n    case $verb:$cur in\n    :*) COMPREPLY=($(compgen -W '", to);
    for (const struct verb *v = verbs; v->name; v++) fprintf(to, " %s", v->name);
    fputs("' -- \"$cur\")) ;;\n", to);
    for (const struct verb *v = verbs; v->name; v++) {
        fprintf(to, "    %s:-*) COMPREPLY=($(compgen -W '", v->name);
        put_options(to, v->name);
        fputs("' -- \"$cur\")) ;;\n", to);
    }
    fputs("    esac\n}\ncomplete -o default -F _fmdsub fmdsub\n", to);
}

static void print_zsh(FILE *to)
{
    fputs("#compdef fmdsub\n# completion of fmdsub for zsh\nlocal -a verbs\nverbs=(\n", to);
    for (const struct verb *v = verbs; v->name; v++) {
        fprintf(to, "    '%s:", v->name);
        put_quoted(to, v->brief, "'\\''");
        fputs("'\n", to);
    }
    fputs(")\nlocal verb=${words[2]}\nif ((CURRENT == 2)); then\n    _describe verb verbs\nelif [[ $PREFIX == -* ]]; "
          "then\n"
          "    case $verb in\n",
          to);
    for (const struct verb *v = verbs; v->name; v++) {
        fprintf(to, "    %s) compadd --", v->name);
        put_options(to, v->name);
        fputs(" ;;\n", to);
    }
    fputs("    esac\nelse\n    _files\nfi\n", to);
}

static void print_fish(FILE *to)
{
    fputs("# completion of fmdsub for fish\n", to);
    for (const struct verb *v = verbs; v->name; v++) {
        fprintf(to, "complete -c fmdsub -n __fish_use_subcommand -f -a %s -d '", v->name);
        put_quoted(to, v->brief, "\\'");
        fputs("'\n", to);
    }
    for (const struct cli_option *o = cli_options; o->name; o++) {
        fputs("complete -c fmdsub", to);
        if (o->verbs) fprintf(to, " -n '__fish_seen_subcommand_from %s'", o->verbs);
        fprintf(to, " -l %s", o->name);
        if (o->letter) fprintf(to, " -s %c", o->letter);
        if (o->value && o->value[0] != '[') fputs(has_choices(o) ? " -x -a '" : " -r", to);
        if (has_choices(o)) put_words(to, o->value);
        fputs(has_choices(o) ? "' -d '" : " -d '", to);
        put_quoted(to, o->brief, "\\'");
        fputs("'\n", to);
    }
}

enum status completion_print(FILE *to, int n, char *const *word, struct report *report)
{
    static const struct {
        const char *shell;
        void (*print)(FILE *to);
    } shells[] = {{"bash", print_bash}, {"zsh", print_zsh}, {"fish", print_fish}};
    for (size_t i = 0; i < sizeof shells / sizeof *shells && n == 1; i++)
        if (strcmp(word[0], shells[i].shell) == 0) return shells[i].print(to), OK;
    return fail(report, E_USAGE, "'fmdsub list completion' takes one of bash, zsh, fish");
}
