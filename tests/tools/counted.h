/* counted.h -- put before every source of a coverage build: what ends at once counts, too.  It includes nothing: names of
 * <unistd.h> are free to sources that do not. */
void __gcov_dump(void);
_Noreturn void end_at_once(int code) __asm__("_exit");

__attribute__((unused)) _Noreturn static void counted_exit(int code)
{
    __gcov_dump();
    end_at_once(code);
}
#define _exit counted_exit
