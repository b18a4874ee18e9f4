// Linked into AUTO-07p with --wrap: of the lines that it writes for every point only the labelled
// ones are left as they are. For the others `other_line` is called, from no_line.f90 or
// short_line.f90. No constant of AUTO shortens its lines or switches them off. The arguments are
// those of subroutine wrline of its module io, the last one a hidden length.
void __real___io_MOD_wrline(void* ap, double* par, void* icu, int* ibr, int* ntot, int* lab,
                            double* vaxis, double* u, long length);
void other_line_(int* ibr, int* ntot, double* par, double* vaxis, double* u);

void __wrap___io_MOD_wrline(void* ap, double* par, void* icu, int* ibr, int* ntot, int* lab,
                            double* vaxis, double* u, long length) {
  if (*lab != 0)
    __real___io_MOD_wrline(ap, par, icu, ibr, ntot, lab, vaxis, u, length);
  else
    other_line_(ibr, ntot, par, vaxis, u);
}
