"""The rules of the games; `registry` lists them."""
