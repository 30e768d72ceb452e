"""An event of another computer: a copy of its file that both keep equal over the network."""
