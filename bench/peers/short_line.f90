! AUTO's line for ordinary points in its own format, cut to lambda and two measures.
subroutine other_line(ibr, ntot, par, vaxis, u)
  implicit none
  integer, intent(in) :: ibr, ntot
  double precision, intent(in) :: par(*), vaxis, u(*)
  write (7, '(I4,I6,I4,I5,3ES19.10)') ibr, mod(ntot - 1, 9999) + 1, 0, 0, par(1), vaxis, u(1)
end subroutine other_line
