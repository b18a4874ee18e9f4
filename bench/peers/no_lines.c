// Linked into AUTO-07p with --wrap: of the lines that it writes for every point only the labelled
// ones are left. This shows what its arithmetic alone costs; no constant of AUTO switches them off.
// The arguments are those of subroutine wrline of its module io, the last one a hidden length.
void __real___io_MOD_wrline(void* ap, void* par, void* icu, int* ibr, int* ntot, int* lab,
                            void* vaxis, void* u, long length);

void __wrap___io_MOD_wrline(void* ap, void* par, void* icu, int* ibr, int* ntot, int* lab,
                            void* vaxis, void* u, long length) {
  if (*lab != 0) __real___io_MOD_wrline(ap, par, icu, ibr, ntot, lab, vaxis, u, length);
}
